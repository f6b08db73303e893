// LabVIEW measurement files, written by hand from the specification of the format.

#include "io/frf/frf_lvm.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <numbers>
#include <string>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "scratch_folder.hpp"

namespace thinwall::io::frf_lvm_test {
namespace {

using Complex = std::complex<double>;

/// What a file is made of; every tab becomes the separator, every point in a number the decimal sign.
struct Lvm {
  std::string x_columns = "One";
  std::string entries =
      "Channels\t3\nSamples\t2\t2\t2\nY_Unit_Label\tm/N\tm/N\t\nX_Dimension\tFrequency\tFrequency\tFrequency\n"
      "X0\t10.0\t10.0\t10.0\nDelta_X\t2.5\t2.5\t2.5\n";
  std::string names = "X_Value\tFRF (Real)\tFRF (Imaginary)\tCoherence\tComment";
  std::string rows = "10.0\t1.0e-6\t-2.0e-6\t0.9\n12.5\t3.0e-6\t-4.0e-6\t1.0\n";
  bool comma = false;
};

std::string text_of(const Lvm& lvm) {
  const std::string data = lvm.comma ? "Comma" : "Tab";
  std::string text = "LabVIEW Measurement\t\nWriter_Version\t2\nReader_Version\t2\nSeparator\t" + data +
                     "\nDecimal_Separator\t.\nMulti_Headings\tNo\nX_Columns\t" + lvm.x_columns +
                     "\nTime_Pref\tRelative\nOperator\tlab\n***End_of_Header***\t\n\t\n" + lvm.entries +
                     "***End_of_Header***\t\t\t\t\n" + lvm.names + "\n" + lvm.rows;
  if (lvm.comma) std::ranges::replace(text, '\t', ',');
  return text;
}

class LvmFile : public test::ScratchFolder {
 protected:
  MeasuredFrf read(const std::string& text, const char* quantity = "receptance", const char* unit = "m/N") {
    core::write_file_atomically(path("tip.lvm"), text);
    return read_lvm_frf(path("tip.lvm"), frf_format(quantity, unit, "Hz"));
  }
  std::string refusal(const std::string& text) {
    return test::message_of<core::DataError>([&] { (void)read(text); });
  }
  std::string refusal(const Lvm& lvm) { return refusal(text_of(lvm)); }
};

void expect_the_frf(const MeasuredFrf& frf) {
  ASSERT_EQ(frf.H.size(), 2);
  EXPECT_EQ(frf.axis.hz, Eigen::Vector2d(10.0, 12.5));
  EXPECT_LT(std::abs(frf.H(0) - Complex(1e-6, -2e-6)), 1e-18);
  EXPECT_LT(std::abs(frf.H(1) - Complex(3e-6, -4e-6)), 1e-18);
}

TEST_F(LvmFile, IsTheSameFrfInEveryForm) {
  Lvm lvm;
  expect_the_frf(read(text_of(lvm)));
  EXPECT_EQ(read(text_of(lvm)).coherence, Eigen::Vector2d(0.9, 1.0));
  lvm.comma = true;
  expect_the_frf(read(text_of(lvm)));
  std::string german = text_of(Lvm{});
  for (const char* number : {"10.0", "12.5", "1.0e-6", "2.0e-6", "3.0e-6", "4.0e-6", "0.9", "1.0\n", "2.5"}) {
    std::string with_comma = number;
    with_comma[with_comma.find('.')] = ',';
    for (std::size_t at = german.find(number); at != std::string::npos; at = german.find(number))
      german.replace(at, with_comma.size(), with_comma);
  }
  german.replace(german.find("Decimal_Separator\t."), 19, "Decimal_Separator\t,");
  expect_the_frf(read(german));
  lvm = {};
  lvm.x_columns = "No";
  lvm.rows = "\t1.0e-6\t-2.0e-6\t0.9\n\t3.0e-6\t-4.0e-6\t1.0\n";
  expect_the_frf(read(text_of(lvm)));
  lvm.x_columns = "Multi";
  lvm.names = "X_Value\tInput\tX_Value\tFRF imag\tX_Value\tFRF real\tComment";
  lvm.rows = "10.0\t7\t10.0\t-2.0e-6\t10.0\t1.0e-6\n12.5\t7\t12.5\t-4.0e-6\t12.5\t3.0e-6\n";
  expect_the_frf(read(text_of(lvm)));
}

TEST_F(LvmFile, MagnitudeAndPhaseAreTakenInTheUnitThatTheChannelSays) {
  Lvm lvm;
  lvm.names = "X_Value\tFRF (Magnitude)\tFRF (Phase)";
  lvm.rows = "10.0\t2.0e-6\t-90\n12.5\t2.0e-6\t60\n";
  EXPECT_NE(refusal(lvm).find("has no unit"), std::string::npos) << "m/N is none of a phase";
  lvm.entries.replace(lvm.entries.find("m/N\tm/N"), 7, "m/N\tdeg");
  const MeasuredFrf frf = read(text_of(lvm));
  EXPECT_LT(std::abs(frf.H(0) - Complex(0.0, -2e-6)), 1e-20);
  EXPECT_LT(std::abs(frf.H(1) - std::polar(2e-6, std::numbers::pi / 3.0)), 1e-20);
  EXPECT_EQ(frf.coherence.size(), 0);
  lvm.entries.replace(lvm.entries.find("m/N\tdeg"), 7, "dB\trad");
  EXPECT_NE(refusal(lvm).find("is in dB"), std::string::npos);
}

TEST_F(LvmFile, AnAccelerationIsConvertedAndUnitsAreTheCallers) {
  const MeasuredFrf frf = read(text_of(Lvm{}), "accelerance", "mm/s^2/N");
  const double omega = 2.0 * std::numbers::pi * 10.0;
  EXPECT_LT(std::abs(frf.H(0) + Complex(1e-9, -2e-9) / (omega * omega)), 1e-24);
}

TEST_F(LvmFile, WhatIsNoFrfIsRefusedWithItsPlace) {
  Lvm lvm;
  EXPECT_NE(refusal("frequency,real,imaginary\n").find("tip.lvm:1: is no LabVIEW measurement file"), std::string::npos);
  EXPECT_NE(refusal(text_of(lvm).substr(0, 200)).find("ends before ***End_of_Header***"), std::string::npos);
  lvm.entries.replace(lvm.entries.find("Frequency"), 9, "Time");
  EXPECT_NE(refusal(lvm).find("is over Time, not frequency"), std::string::npos);
  lvm = {};
  lvm.names = "X_Value\tVoltage\tForce\tCoherence";
  EXPECT_NE(refusal(lvm).find("no channels of real and imaginary part"), std::string::npos);
  lvm.names = "X_Value\tReal 1\tReal 2\tImag";
  EXPECT_NE(refusal(lvm).find("two channels are named as one: \"Real 1\" and \"Real 2\""), std::string::npos);
  lvm = {};
  lvm.rows += "***End_of_Header***\n";
  EXPECT_NE(refusal(lvm).find("a second record begins"), std::string::npos);
  lvm = {};
  lvm.rows = "10.0\t1.0e-6\tx\t0.9\n12.5\t1\t1\t1\n";
  EXPECT_NE(refusal(lvm).find("tip.lvm:20"), std::string::npos) << refusal(lvm);
  lvm = {};
  lvm.rows = "12.5\t1\t1\t1\n10\t1\t1\t1\n";
  EXPECT_NE(refusal(lvm).find("sort the lines by rising frequency"), std::string::npos);
}

}  // namespace
}  // namespace thinwall::io::frf_lvm_test

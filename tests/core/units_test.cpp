#include "core/units.hpp"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "core/error.hpp"

namespace thinwall::core::units_test {
namespace {

std::string message_of(const std::string& text, const QuantityKind& kind) {
  try {
    (void)parse_quantity(text, kind);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Units, QuantitiesOfMachiningReadAsTheirSiValue) {
  EXPECT_DOUBLE_EQ(parse_quantity("6 mm", kind::length), 0.006);
  EXPECT_DOUBLE_EQ(parse_quantity("6mm", kind::length), 0.006);
  EXPECT_DOUBLE_EQ(parse_quantity(" -20 um ", kind::length), -2e-5);
  EXPECT_DOUBLE_EQ(parse_quantity("3 µm", kind::length), 3e-6);
  EXPECT_DOUBLE_EQ(parse_quantity("210 GPa", kind::stress), 2.1e11);
  EXPECT_DOUBLE_EQ(parse_quantity("600 N/mm^2", kind::stress), 6e8);
  EXPECT_DOUBLE_EQ(parse_quantity("600 N/mm²", kind::stress), 6e8);
  EXPECT_DOUBLE_EQ(parse_quantity("1900 rpm", kind::spindle_speed), 1900.0);
  EXPECT_DOUBLE_EQ(parse_quantity("62.83185307179586 rad/s", kind::spindle_speed), 600.0);
  EXPECT_DOUBLE_EQ(parse_quantity("7850 kg/m^3", kind::density), 7850.0);
  EXPECT_DOUBLE_EQ(parse_quantity("7.85 g/cm^3", kind::density), 7850.0);
  EXPECT_DOUBLE_EQ(parse_quantity("1800 mm/min", kind::velocity), 0.03);
  EXPECT_DOUBLE_EQ(parse_quantity("1.7e6 N/m", kind::stiffness), 1.7e6);
  EXPECT_DOUBLE_EQ(parse_quantity("1.7 N/um", kind::stiffness), 1.7e6);
  EXPECT_DOUBLE_EQ(parse_quantity("12 N s/m", kind::damping), 12.0);
  EXPECT_DOUBLE_EQ(parse_quantity("12 N·s/m", kind::damping), 12.0);
  EXPECT_DOUBLE_EQ(parse_quantity("12 N*s*m^-1", kind::damping), 12.0);
  EXPECT_DOUBLE_EQ(parse_quantity("2 %", kind::number), 0.02);
  EXPECT_DOUBLE_EQ(parse_quantity("45 deg", kind::angle), std::numbers::pi / 4);
  EXPECT_DOUBLE_EQ(parse_quantity("2.9 kHz", kind::frequency), 2900.0);
  EXPECT_DOUBLE_EQ(parse_quantity("12 1/s", kind::rate), 12.0);
  EXPECT_DOUBLE_EQ(parse_quantity("4 GB", kind::memory), 4e9);
  EXPECT_DOUBLE_EQ(parse_quantity("0.006", kind::length), 0.006);
}

TEST(Units, EveryExampleOfAKindIsOfThatKind) {
  using namespace kind;
  for (const auto& k : {number, length, mass, kind::time, angle, density, stress, frequency, spindle_speed, velocity,
                        stiffness, damping, rate, memory}) {
    EXPECT_NO_THROW((void)parse_quantity(k.example, k)) << k.name;
  }
}

TEST(Units, ADivisionBindsOnlyTheFactorThatFollows) {
  EXPECT_EQ(parse_unit("m/s^2/N").dimension, (Dimension{0, -1, 0, 0, 0}));
  EXPECT_EQ(parse_unit("N s/m").dimension, (Dimension{0, 1, -1, 0, 0}));
  EXPECT_DOUBLE_EQ(parse_unit("N/mm/um").value, 1e9);
}

TEST(Units, AUnitThatCancelsOrHasNoEndIsRefused) {
  EXPECT_NE(message_of("60 m^-1/m^-2", kind::length).find("multiplies and divides by m; write what remains"),
            std::string::npos);
  EXPECT_NE(message_of("60 mm^3/mm^2", kind::length).find("multiplies and divides by mm"), std::string::npos);
  std::string long_unit = "60 m";
  for (int i = 0; i < 100000; ++i) long_unit += "*m/m";
  EXPECT_NE(message_of(long_unit, kind::length).find("more than 12 factors"), std::string::npos);
  EXPECT_DOUBLE_EQ(parse_unit("mm/s/s").value, 1e-3) << "a unit may divide twice";
}

TEST(Units, HertzRadiansPerSecondAndRpmAreToldApart) {
  EXPECT_NE(parse_unit("Hz").dimension, parse_unit("rad/s").dimension);
  EXPECT_EQ(parse_unit("rpm").dimension, parse_unit("rad/s").dimension);
  EXPECT_EQ(parse_unit("Hz").dimension, parse_unit("1/s").dimension);
  EXPECT_NE(message_of("29 Hz", kind::spindle_speed).find("is a frequency, but a spindle speed is expected"),
            std::string::npos);
  EXPECT_NE(message_of("182 rad/s", kind::frequency).find("angular velocity"), std::string::npos);
}

TEST(Units, AWrongDimensionNamesWhatWasExpectedWhatWasGotAndAnExample) {
  const auto message = message_of("210 mm", kind::stress);
  EXPECT_EQ(message, "\"210 mm\" is a length, but a stress is expected; write for example \"210 GPa\"");
}

TEST(Units, ABareSpindleSpeedIsRefusedWithTheRemedy) {
  EXPECT_NE(message_of("1900", kind::spindle_speed).find("write \"1900 rpm\""), std::string::npos);
  EXPECT_THROW((void)bare_number(1900.0, kind::spindle_speed), InputError);
}

TEST(Units, BadTextIsRefusedWithItsCause) {
  EXPECT_NE(message_of("6 mmm", kind::length).find("did you mean \"mm\"?"), std::string::npos);
  EXPECT_NE(message_of("six mm", kind::length).find("does not start with a number"), std::string::npos);
  EXPECT_NE(message_of("1e400 mm", kind::length).find("beyond the range of a double"), std::string::npos);
  EXPECT_NE(message_of("1e-400 mm", kind::length).find("beyond the range of a double"), std::string::npos);
  EXPECT_NE(message_of("6,5 mm", kind::length).find("decimal comma"), std::string::npos);
  EXPECT_NE(message_of("inf m", kind::length).find("not a finite number"), std::string::npos);
  EXPECT_NE(message_of("nan", kind::length).find("not a finite number"), std::string::npos);
  EXPECT_NE(message_of("3 m^x", kind::length).find("exponent"), std::string::npos);
  EXPECT_NE(message_of("3 m/", kind::length).find("ends with"), std::string::npos);
  EXPECT_NE(message_of("", kind::length).find("does not start with a number"), std::string::npos);
}

TEST(Units, AUnitOfTheFieldIsAnsweredWithTheOneThatIsMeant) {
  EXPECT_NE(message_of("5000 RPM", kind::spindle_speed).find("did you mean \"rpm\"?"), std::string::npos);
  EXPECT_NE(message_of("5000 U/min", kind::spindle_speed).find("did you mean \"rpm\"?"), std::string::npos);
  EXPECT_NE(message_of("5000 min-1", kind::spindle_speed).find("did you mean \"rpm\"?"), std::string::npos);
  EXPECT_EQ(message_of("5000 1/min", kind::spindle_speed),
            "\"5000 1/min\" is a frequency, but a spindle speed is expected; write \"5000 rpm\"");
  EXPECT_NE(message_of("5 1/min", kind::length).find("write for example \"6 mm\""), std::string::npos);
  EXPECT_NE(message_of("3 Nm", kind::torque).find("did you mean \"N m\"?"), std::string::npos);
  EXPECT_NE(message_of("3 N/mm2", kind::stress).find("did you mean \"N/mm^2\"?"), std::string::npos);
}

TEST(Units, ARangeIsToldByItsEnds) {
  const std::pair<std::string, std::string> ends("2 mm", "4 mm");
  for (const auto* text : {"2 mm - 4 mm", "2-4 mm", "2 mm to 4 mm", "2..4 mm", "2 mm – 4 mm"})
    EXPECT_EQ(range_ends(text), ends) << text;
  EXPECT_EQ(range_ends("-2 mm - -1 mm"), std::pair(std::string("-2 mm"), std::string("-1 mm")));
  for (const auto* text : {"5000 min-1", "1e-3 mmm", "mm", "-", "4 m-", ""}) EXPECT_FALSE(range_ends(text)) << text;
}

TEST(Units, TextOfAQuantityReadsBackToTheLastBit) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> mantissa(-10.0, 10.0), exponent(-12.0, 12.0);
  for (int i = 0; i < 2000; ++i) {
    const double x = mantissa(random) * std::pow(10.0, exponent(random));
    for (const auto& k : {kind::number, kind::length, kind::stress, kind::spindle_speed, kind::damping, kind::memory}) {
      EXPECT_EQ(parse_quantity(exact_text(x, k), k), x);
    }
  }
}

TEST(Units, PeopleReadAFittingUnit) {
  EXPECT_EQ(readable_text(0.392, kind::length), "392 mm");
  EXPECT_EQ(readable_text(2.1e11, kind::stress), "210 GPa");
  EXPECT_EQ(readable_text(1900.0, kind::spindle_speed), "1900 rpm");
  EXPECT_EQ(readable_text(2.5e-6, kind::length), "2.5 µm");
  EXPECT_EQ(readable_text(0.0, kind::length), "0 m");
}

TEST(Units, ACommaLocaleChangesNothing) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr && std::setlocale(LC_ALL, "fr_FR.UTF-8") == nullptr) {
    GTEST_SKIP() << "no locale with a decimal comma is installed";
  }
  EXPECT_DOUBLE_EQ(parse_quantity("1.5 mm", kind::length), 0.0015);
  EXPECT_EQ(exact_text(0.0015, kind::length), "0.0015 m");
  EXPECT_EQ(readable_text(0.0015, kind::length), "1.5 mm");
  std::setlocale(LC_ALL, before.c_str());
}

}  // namespace
}  // namespace thinwall::core::units_test

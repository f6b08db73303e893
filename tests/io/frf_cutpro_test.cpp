#include "io/frf/frf_cutpro.hpp"

#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "core/error.hpp"
#include "io/frf/frf_csv.hpp"
#include "scratch_folder.hpp"
#include "tests/processor_time.hpp"

namespace thinwall::io::test::frf_cutpro_test {

namespace {

using Complex = std::complex<double>;

class CutproFile : public ScratchFolder {
 protected:
  [[nodiscard]] std::string refusal(const std::string& content, const std::optional<FrfFormat>& stated = {}) const {
    const auto file = write("tap.frf", content);
    return message_of<core::DataError>([&] { (void)read_cutpro_frf(file, stated); });
  }
};

const std::string lines =
    "1.000000e+01\t1.000000000000e-08\t-2.000000000000e-09\t\n"
    "2.000000e+01\t2.5e-08\t-3.0e-09\t\n";

void expect_receptance(const MeasuredFrf& frf, Complex factor = 1.0) {
  ASSERT_EQ(frf.axis.size(), 2);
  EXPECT_EQ(frf.axis.hz, Eigen::Vector2d(10.0, 20.0));
  EXPECT_LE(std::abs(frf.H(0) - factor * Complex(1e-8, -2e-9)), 1e-15 * std::abs(frf.H(0)));
  EXPECT_LE(std::abs(frf.H(1) - factor * Complex(2.5e-8, -3e-9)), 1e-15 * std::abs(frf.H(1)));
}

}  // namespace

// As a public script writes it for CutPro: names and units behind the numbers of the first line.
TEST_F(CutproFile, TellsItsUnitsBehindTheFirstLine) {
  const std::string first =
      "  1.000000e+01\t1.000000000000e-08\t-2.000000000000e-09\tFreq\tHz\tReal\tm/N\tImag\tReal\t\n";
  expect_receptance(read_cutpro_frf(write("FRFX.frf", first + "  2.000000e+01\t2.5e-08\t-3.0e-09\t\n")));
}

TEST_F(CutproFile, TellsItsUnitsInLinesAboveOrTheCallerDoes) {
  expect_receptance(
      read_cutpro_frf(write("a.frf", "Tap test of 3 flutes\nFreq (Hz)  Real [m/N]  Imag [m/N]\r\n\n" + lines)));
  expect_receptance(read_cutpro_frf(write("b.frf", "Freq [Hz] Real [um/N] Imag [um/N]\n" + lines)), 1e-6);
  expect_receptance(read_cutpro_frf(write("c.frf", lines), frf_format("receptance", "um/N", "Hz")), 1e-6);
  expect_receptance(read_cutpro_frf(write("d.frf", "m/N\n" + lines), frf_format("receptance", "m/N", "Hz")));
  const MeasuredFrf accelerance = read_cutpro_frf(write("e.frf", "Hz m/s^2/N\n" + lines));
  const double omega = 2.0 * std::numbers::pi * 20.0;
  EXPECT_NEAR(accelerance.H(1).real(), -2.5e-8 / (omega * omega), 1e-25);
}

TEST_F(CutproFile, OfUnknownUnitsOrAnotherFormIsRefused) {
  const auto expect = [](const std::string& message, const std::string& cause) {
    EXPECT_NE(message.find(cause), std::string::npos) << message;
  };
  expect(refusal(lines), "tells no unit of the response");
  expect(refusal("m/N\n" + lines), "tells no unit of the frequency");
  expect(refusal("Hz m/N um/N\n" + lines), "tap.frf:1: \"um/N\" is another unit");
  expect(refusal("Hz rad/s\n" + lines), "tap.frf:1: two different units of frequency");
  expect(refusal("Hz m/N\n" + lines, frf_format("receptance", "um/N", "Hz")), "tells another quantity or unit");
  expect(refusal("Hz m/N\n" + lines, frf_format("receptance", "m/N", "rad/s")), "tells another unit of frequency");
  expect(refusal("Hz m/N\n" + lines + "30 1e-8\n"), "tap.frf:4: 2 columns where 3");
  expect(refusal("Hz m/N\n" + lines + "30 1e-8 2e-8 4\n"), "tap.frf:4: 4 columns where 3");
  expect(refusal("Hz m/N\n10 1 2 3\n" + lines), "tap.frf:2: more than three numbers");
  expect(refusal("Hz m/N\n" + lines + "30 1e-8 end\n"), "tap.frf:4: column 3: \"end\" is not a number");
  expect(refusal("Hz m/N\n" + lines + "15 1e-8 0\n"), "sort the lines");
  expect(refusal("Hz m/N\n" + lines + "30 1,5e-8 0\n"), "decimal comma");
  expect(refusal("Hz m/N\n"), "holds no line of three numbers");
  expect(refusal(""), "holds no line of three numbers");
}

// Found by fuzzing: each word was tried as four units, a second for a fifth of a megabyte, and brackets were taken off
// one by one from the front.
TEST_F(CutproFile, OfAnotherKindIsRefusedSoonAndAtTheLine) {
  std::string table;
  for (int line = 0; line < 300000; ++line) table += "1,2,3\n";
  const std::string brackets = "Hz " + std::string(2000000, '(') + "m/N" + std::string(2000000, ')') + "\n" + lines;
  const double start = tests::processor_seconds();
  EXPECT_NE(refusal(table).find("tap.frf:1001: more than 1000 words"), std::string::npos) << refusal(table);
  EXPECT_NE(refusal("Hz m/N " + std::string(2000000, 'm') + "\n").find("no line of three"), std::string::npos);
  expect_receptance(read_cutpro_frf(write("brackets.frf", brackets)));
  EXPECT_LT(tests::processor_seconds() - start, 20.0);
}

}  // namespace thinwall::io::test::frf_cutpro_test

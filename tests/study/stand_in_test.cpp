// Modes that stand in for a part's in forecasts.

#include "study/lobes/stand_in.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "case/reader.hpp"

namespace thinwall::tests::stand_in_test {

namespace {

/// A block of 100 x 60 x 20 mm with pockets, zones in the syntax of a case.
milling::RelativeStructure modes_of_block(const std::string& zones) {
  const std::string text =
      "title = \"block\"\n[part]\nshape = \"prism\"\n"
      "outline = [[\"0 mm\", \"0 mm\"], [\"100 mm\", \"0 mm\"], [\"100 mm\", \"60 mm\"], [\"0 mm\", \"60 mm\"]]\n"
      "thickness = \"20 mm\"\n" +
      zones +
      "[part.material]\nyoungs_modulus = \"70 GPa\"\npoisson_ratio = 0.33\ndensity = \"2800 kg/m^3\"\n"
      "[[part.supports]]\non = \"x_min\"\n[points.P]\nposition = [\"50 mm\", \"30 mm\", \"0 mm\"]\n"
      "[damping]\nratio = 0.01\n";
  return study::modes_like(cases::parse_case(text, "."));
}

std::string pocket(double from_mm, double to_mm, double floor_mm) {
  const auto mm = [](double length) { return "\"" + std::to_string(length) + " mm\""; };
  const std::string from = mm(from_mm), to = mm(to_mm), low = mm(5.0), high = mm(55.0);
  return "[[part.zones]]\noutline = [[" + from + ", " + low + "], [" + to + ", " + low + "], [" + to + ", " + high +
         "], [" + from + ", " + high + "]]\nthickness = " + mm(floor_mm) + "\n";
}

/// The spacing of the modes of a plate, Hz: 2 c_L t / (√12 A) (Cremer, Heckl & Petersson 2005).
double apart_hz(double thickness_m, double area_m2) {
  return 2.0 * std::sqrt(70e9 / 2800.0) * thickness_m / (std::sqrt(12.0) * area_m2);
}

double first_hz(const milling::RelativeStructure& modes) {
  return std::abs(modes.poles(0)) / (2.0 * std::numbers::pi);
}

TEST(StandIn, ModesOfAPocketedBlockAreThoseOfTheFloorsWithTheDensestModes) {
  EXPECT_NEAR(first_hz(modes_of_block("")) / apart_hz(0.02, 0.1 * 0.06), 1.0, 1e-9);
  EXPECT_NEAR(first_hz(modes_of_block(pocket(5.0, 95.0, 2.0))) / apart_hz(0.002, 0.09 * 0.05), 1.0, 1e-9);
  const std::string two = pocket(5.0, 35.0, 2.0) + pocket(40.0, 60.0, 2.0) + pocket(70.0, 95.0, 8.0);
  EXPECT_NEAR(first_hz(modes_of_block(two)) / apart_hz(0.002, 0.05 * 0.05), 1.0, 1e-9)
      << "floors of one thickness count together";
  EXPECT_NEAR(first_hz(modes_of_block(pocket(5.0, 6.0, 1.0))) / apart_hz(0.02, 0.1 * 0.06), 1.0, 1e-9)
      << "the modes of a narrow groove are sparser than those of the block";
}

TEST(StandIn, ModesOfAPocketMoveAlongTheNormalOfItsFloor) {
  const milling::RelativeStructure modes = modes_of_block(pocket(5.0, 95.0, 2.0));
  EXPECT_GT(std::abs(modes.phi(2, 0)), 5.0 * std::abs(modes.phi(0, 0)));
}

}  // namespace

}  // namespace thinwall::tests::stand_in_test

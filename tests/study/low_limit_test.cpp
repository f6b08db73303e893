// Limits that hang on measured lines below the first resonance.

#include "study/lobes/low_limit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/milling/single_mode.hpp"

namespace thinwall::tests::low_limit_test {

using namespace study;

namespace {

milling::RelativeStructure mode_at(double hz) {
  return milling::relative_structure(milling::testing::modal_model({{hz, 0.03, 0.4, Eigen::Vector3d::UnitX()}}), "P");
}

/// Lines of a mode at 600 Hz, the lowest ten of them as an integrator's noise makes them, every other one small.
milling::FittedStructure measured(double step_hz) {
  milling::FittedStructure structure;
  milling::SampledReceptance& samples = structure.lines.samples;
  const auto lines = static_cast<Eigen::Index>(3000.0 / step_hz);
  samples.frequency_hz = Eigen::VectorXd::LinSpaced(lines, step_hz, step_hz * static_cast<double>(lines));
  for (const double hz : samples.frequency_hz)
    samples.H.push_back(milling::receptance(mode_at(600.0), 2.0 * std::numbers::pi * hz));
  for (std::size_t line = 1; line < 10; line += 2) samples.H[line](0, 0) = 1e-3 / static_cast<double>(line * line);
  return structure;
}

milling::LobeRow limited_at(double chatter_hz) {
  milling::LobeRow row;
  row.crossings.emplace_back();
  row.crossings.front().chatter_frequency_hz = chatter_hz;
  return row;
}

TEST(LowLimit, IsToldIfChatterLiesBelowTheFirstResonance) {
  const milling::FittedStructure structure = measured(2.0);
  const auto found = limit_below_resonance(structure, limited_at(8.0));
  ASSERT_TRUE(found) << "a peak of noise is no resonance";
  EXPECT_EQ(found->chatter_frequency_hz, 8.0);
  EXPECT_NEAR(found->first_resonance_hz, 600.0, 2.0);
}

TEST(LowLimit, IsNoneOfASoundOne) {
  const milling::FittedStructure structure = measured(2.0);
  EXPECT_FALSE(limit_below_resonance(structure, limited_at(580.0))) << "within two half widths of 18 Hz";
  EXPECT_FALSE(limit_below_resonance(structure, limited_at(640.0)));
  milling::LobeRow stable;
  stable.at_limit = true;
  EXPECT_FALSE(limit_below_resonance(structure, stable));
  EXPECT_FALSE(limit_below_resonance(mode_at(600.0), limited_at(8.0))) << "known by its poles";
  EXPECT_FALSE(limit_below_resonance(measured(40.0), limited_at(8.0))) << "no resonance is resolved";
}

TEST(LowLimit, TakesTheModesOfThePartForResonancesToo) {
  milling::FittedStructure structure = measured(2.0);
  structure.lines.poles = mode_at(120.0);
  EXPECT_FALSE(limit_below_resonance(structure, limited_at(124.0)));
  EXPECT_NEAR(limit_below_resonance(structure, limited_at(8.0)).value().first_resonance_hz, 120.0, 1e-9);
}

}  // namespace

}  // namespace thinwall::tests::low_limit_test

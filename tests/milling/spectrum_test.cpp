// Spectra of known sines, and of cuts whose chatter frequency the lobes know.

#include "milling/simulation/spectrum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "milling/direct/stability.hpp"
#include "milling/simulation/simulation.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::milling::spectrum_test {
namespace {

constexpr double pi = std::numbers::pi;

TEST(Spectrum, OfSinesHasTheirFrequenciesAndAmplitudes) {
  constexpr double step_s = 1e-4;
  Eigen::VectorXd samples(10000);
  for (Eigen::Index i = 0; i < samples.size(); ++i) {
    const double t = static_cast<double>(i) * step_s;
    samples(i) = 5.0 + 3.0 * std::sin(2.0 * pi * 600.0 * t) + 0.2 * std::cos(2.0 * pi * 300.0 * t) +
                 1.0 * std::sin(2.0 * pi * 911.3 * t + 0.7);
  }
  const auto lines = spectral_lines(spectrum_of(samples, step_s), 300.0, 2, false);
  ASSERT_GE(lines.size(), 3u);
  EXPECT_NEAR(lines[0].frequency_hz, 600.0, 1e-3);
  EXPECT_NEAR(lines[0].amplitude, 3.0, 1e-4);
  EXPECT_EQ(lines[0].origin, LineOrigin::tooth_passing);
  EXPECT_NEAR(lines[1].frequency_hz, 911.3, 1e-3);
  EXPECT_NEAR(lines[1].amplitude, 1.0, 1e-3);
  EXPECT_EQ(lines[1].origin, LineOrigin::other);
  EXPECT_NEAR(lines[2].frequency_hz, 300.0, 1e-3);
  EXPECT_NEAR(lines[2].amplitude, 0.2, 1e-3);
  EXPECT_EQ(lines[2].origin, LineOrigin::spindle);
  // Teeth that are alike make no line there; every second one may, in a flip.
  EXPECT_EQ(spectral_lines(spectrum_of(samples, step_s), 300.0, 2, true)[2].origin, LineOrigin::other);
}

TEST(Spectrum, RefusesTooFewSamples) {
  EXPECT_THROW((void)spectrum_of(Eigen::VectorXd::Ones(7), 1e-3), core::InputError);
  EXPECT_THROW((void)spectrum_of(Eigen::VectorXd::Ones(100), 0.0), core::InputError);
}

/// Just beyond the boundary the motion is of the size at which teeth begin to leave the cut, and its strongest foreign
/// line lies where the multiplier says, one of (arg μ + 2πk)/T.
TEST(Spectrum, HasTheChatterFrequencyOfTheLobes) {
  const RelativeStructure structure =
      relative_structure(testing::modal_model({{922.0, 0.011, 0.03993, Eigen::Vector3d::UnitX()},
                                               {922.0, 0.011, 0.03993, Eigen::Vector3d::UnitY()}}),
                         "P");
  MillingProcess process;
  process.cutter = {2, 0.01};
  process.coefficients = {6e8, 2e8, 0.0, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, 1e-3, MillingDirection::down);
  constexpr double rpm = 6000.0;
  const LobeRow row = limiting_depth(structure, process, rpm, {});
  SimulationOptions options;
  options.settling_turns = 3000;
  options.recorded_turns = options.traced_turns = 200;
  const SimulatedCut cut =
      simulate(structure, process, process.coefficients, {rpm, 1.02 * row.limiting_depth_m, 1e-4}, options);
  ASSERT_EQ(cut.motion.motion, Motion::quasi_periodic);
  const auto lines =
      spectral_lines(spectrum_of(cut.trace.displacement_m.row(0), cut.trace.step_s), rpm / 60.0, 2, true, 40);
  const auto chatter = std::ranges::find(lines, LineOrigin::other, &SpectralLine::origin);
  ASSERT_NE(chatter, lines.end());
  EXPECT_NEAR(chatter->frequency_hz, row.chatter_frequency_hz, 0.005 * row.chatter_frequency_hz);
}

}  // namespace
}  // namespace thinwall::milling::spectrum_test

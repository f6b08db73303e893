// Which lines of an FRF are believed: noise, offsets, low coherence and lines that give energy are left out, and no
// line of a sound FRF is.

#include "dynamics/believable_band.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/error.hpp"

namespace thinwall::dynamics::testing::believable_band_test {

namespace {

using Complex = std::complex<double>;

constexpr double static_receptance = 1.0 / 2e7;

struct Mode {
  double hz, damping, share;
};

Eigen::VectorXcd receptance(const FrequencyAxis& axis, const std::vector<Mode>& modes) {
  Eigen::VectorXcd H = Eigen::VectorXcd::Zero(axis.size());
  for (Eigen::Index k = 0; k < axis.size(); ++k) {
    for (const Mode& mode : modes) {
      const double r = axis.hz(k) / mode.hz;
      H(k) += mode.share * static_receptance / Complex(1.0 - r * r, 2.0 * mode.damping * r);
    }
  }
  return H;
}

/// A tool of two modes from 0 Hz on.
const FrequencyAxis axis = linear_axis(0.0, 2000.0, 2001);
const Eigen::VectorXcd tool = receptance(axis, {{620.0, 0.03, 1.0}, {1340.0, 0.025, 0.4}});
constexpr LineKnowledge of_tool{.driving_point = true, .held = true};

/// An error of the accelerance, m/(s² N), as it is in the receptance; at 0 Hz as at the first line.
Complex integrated(Complex error, Eigen::Index line) {
  return -error / std::pow(axis.omega_rad_s(std::max<Eigen::Index>(line, 1)), 2);
}

/// The accelerance at which the receptance is as large as at rest, at this frequency.
double as_large_at(double hz) {
  return 1.4 * static_receptance * std::pow(2.0 * std::numbers::pi * hz, 2);
}

Eigen::VectorXcd with_noise(double as_large_hz, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0.0, as_large_at(as_large_hz) / std::numbers::sqrt2);
  Eigen::VectorXcd H = tool;
  for (Eigen::Index line = 0; line < H.size(); ++line) {
    const double real = normal(random), imag = normal(random);
    H(line) += integrated({real, imag}, line);
  }
  return H;
}

Eigen::VectorXcd with_offset(Complex offset) {
  Eigen::VectorXcd H = tool;
  for (Eigen::Index line = 0; line < H.size(); ++line) H(line) += integrated(offset, line);
  return H;
}

TEST(BelievableBand, LeavesOutTheNoiseOfAnIntegrator) {
  // The noise is a fifth of the receptance at √5 times the frequency at which it is as large; the estimate of σ there
  // is known to 60 % (LowFrequencyLimit).
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const BelievableBand band = believable_band(axis, with_noise(10.0, seed), {}, of_tool);
    EXPECT_TRUE(band.below == LineDoubt::scatter || band.below == LineDoubt::energy) << seed;
    EXPECT_GT(band.from_hz, 12.0) << seed;
    EXPECT_LT(band.from_hz, 40.0) << seed;
    EXPECT_EQ(band.to_hz, 2000.0);
  }
}

TEST(BelievableBand, TakesTheStatedNoiseForABoundOfTheScatter) {
  LineKnowledge stated = of_tool;
  const Eigen::VectorXcd H = with_noise(10.0, 3);
  const double unstated_hz = believable_band(axis, H, {}, of_tool).from_hz;
  stated.noise = 0.01;
  EXPECT_GT(believable_band(axis, H, {}, stated).from_hz, 1.2 * unstated_hz) << "lines that scatter by more";
  stated.noise = 0.2;
  EXPECT_LT(believable_band(axis, H, {}, stated).from_hz, 0.8 * unstated_hz) << "so much was to be expected";
}

TEST(BelievableBand, LeavesOutASmoothErrorThatGrowsAsAnIntegratorsDoes) {
  for (const double sign : {1.0, -1.0}) {
    const Eigen::VectorXcd H = with_offset(sign * as_large_at(10.0));
    const BelievableBand band = believable_band(axis, H, {}, of_tool);
    EXPECT_EQ(band.below, LineDoubt::growth);
    EXPECT_NEAR(band.from_hz, 10.0, 3.0);
    const LineKnowledge free{.driving_point = true, .held = false};
    EXPECT_EQ(believable_band(axis, H, {}, free).below, LineDoubt::none) << "a free part grows so";
  }
}

TEST(BelievableBand, LeavesOutLinesThatGiveEnergy) {
  const Complex giving(0.0, -as_large_at(20.0));
  const BelievableBand band = believable_band(axis, with_offset(giving), {}, {.driving_point = true, .held = false});
  EXPECT_EQ(band.below, LineDoubt::energy);
  // Im H/|H| = b/√(1 + b²) is a tenth where b/ω² is: √10 times where it is 1.
  EXPECT_NEAR(band.from_hz, 20.0 * std::sqrt(10.0), 6.0);
  const LineKnowledge cross{.driving_point = false, .held = false};
  EXPECT_EQ(believable_band(axis, with_offset(giving), {}, cross).below, LineDoubt::none);
  EXPECT_EQ(believable_band(axis, tool.conjugate(), {}, of_tool).below, LineDoubt::none)
      << "all lines: a matter of their sign, and no band is better";
}

TEST(BelievableBand, LeavesOutTheLineAtRestThatFitsNoOther) {
  Eigen::VectorXcd H = tool;
  H(0) *= 3.0;
  const BelievableBand band = believable_band(axis, H, {}, of_tool);
  EXPECT_EQ(band.below, LineDoubt::growth);
  EXPECT_EQ(band.from_hz, 1.0);
}

TEST(BelievableBand, LeavesOutIncoherentLinesAtBothEndsButNotAmongTheOthers) {
  Eigen::VectorXd coherence = Eigen::VectorXd::Ones(axis.size());
  for (Eigen::Index line = 0; line < coherence.size(); ++line) {
    const double hz = axis.hz(line);
    if (hz < 50.0 || hz > 1800.0 || std::abs(hz - 900.0) < 30.0) coherence(line) = 0.5;
  }
  const BelievableBand band = believable_band(axis, tool, coherence, of_tool);
  EXPECT_EQ(band.below, LineDoubt::coherence);
  EXPECT_EQ(band.above, LineDoubt::coherence);
  EXPECT_NEAR(band.from_hz, 50.0, 1.0);
  EXPECT_NEAR(band.to_hz, 1800.0, 1.0);
}

// Spacings up to the half width of the sharpest mode, first lines anywhere, also on the flank of a mode below them, and
// noise of up to 1 % of each line.
TEST(BelievableBand, LeavesNoLineOfASoundFrfOut) {
  std::mt19937_64 random(7);
  const auto uniform = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); };
  std::normal_distribution<double> normal;
  for (int structure = 0; structure < 200; ++structure) {
    std::vector<Mode> modes(static_cast<std::size_t>(uniform(1.0, 6.0)));
    double half_width = INFINITY;
    for (Mode& mode : modes) {
      mode = {uniform(40.0, 1500.0), uniform(0.004, 0.05), uniform(0.2, 1.0)};
      half_width = std::min(half_width, mode.hz * mode.damping);
    }
    const double step = half_width * uniform(0.1, 1.0);
    const double first = structure % 2 == 0 ? step * std::floor(uniform(0.0, 3.0)) : uniform(20.0, 400.0);
    const FrequencyAxis lines = linear_axis(first, first + 2000.0, 1 + static_cast<int>(2000.0 / step));
    Eigen::VectorXcd H = receptance(lines, modes);
    const double noise = structure % 3 == 0 ? 0.0 : uniform(0.0, 0.01);
    for (Complex& value : H) value *= 1.0 + noise * Complex(normal(random), normal(random));
    const BelievableBand band =
        believable_band(lines, H, Eigen::VectorXd::Constant(lines.size(), 0.98), {true, true, noise});
    EXPECT_EQ(band.below, LineDoubt::none) << structure << ": " << band.from_hz << " of " << first;
    EXPECT_EQ(band.from_hz, lines.hz(0)) << structure;
    EXPECT_EQ(band.to_hz, lines.hz(lines.size() - 1)) << structure;
  }
}

TEST(BelievableBand, BelievesFewLinesAndRefusesWhatDoesNotFit) {
  EXPECT_EQ(believable_band(linear_axis(0.0, 20.0, 21), tool.head(21).reverse(), {}, of_tool).below, LineDoubt::none);
  EXPECT_THROW((void)believable_band(axis, tool.head(30), {}, of_tool), core::InputError);
  EXPECT_THROW((void)believable_band(axis, tool, Eigen::VectorXd::Ones(3), of_tool), core::InputError);
}

}  // namespace

}  // namespace thinwall::dynamics::testing::believable_band_test

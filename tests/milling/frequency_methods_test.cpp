// The zeroth-order and the multi-frequency solution: closed forms, published minima, each other, the direct method.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "milling/classical/multi_frequency.hpp"
#include "milling/classical/zeroth_order.hpp"
#include "milling/direct/stability.hpp"
#include "tests/milling/benchmark.hpp"

namespace thinwall::milling::frequency_methods_test {
namespace {

using std::complex;
using testing::benchmark_process;
using testing::benchmark_structure;
using testing::modal_model;
using testing::Reference;
using testing::references;

constexpr double pi = std::numbers::pi;

const std::vector<testing::Mode> two_directions{{212.0, 0.01, 0.5, Eigen::Vector3d(1.0, 0.2, 0.1)},
                                                {567.0, 0.02, 0.3, Eigen::Vector3d(0.3, -0.8, 0.0)}};

MillingProcess wall_cut(double radial_m) {
  MillingProcess process;
  process.cutter = {4, 0.016};
  process.coefficients = {2e9, 0.8e9, 0.3e9, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, radial_m, MillingDirection::down);
  return process;
}

TEST(DirectionalHarmonics, AreTheIntegralsInClosedForm) {
  // A_xx of a tooth is K_t sin φ cos φ + K_r sin² φ, a sum of e^{2iφ}, 1 and e^{−2iφ}; the period is φ's pitch, begun
  // at entry.
  for (const double immersion : {0.05, 0.3, 1.0}) {
    const MillingProcess process = benchmark_process(immersion);
    const auto [entry, exit] = process.engagement;
    const auto A = directional_harmonics(process, 12);
    for (int r = 0; r <= 12; ++r) {
      const auto integral = [&, entry = entry, exit = exit](double rate, complex<double> factor) {
        const complex<double> i_rate(0.0, rate - 2.0 * r);
        const complex<double> value =
            rate == 2.0 * r ? exit - entry : (std::exp(i_rate * exit) - std::exp(i_rate * entry)) / i_rate;
        return factor * value;
      };
      const complex<double> sum = integral(2.0, complex<double>(-0.25 * 2e8, -0.25 * 6e8)) + integral(0.0, 0.5 * 2e8) +
                                  integral(-2.0, complex<double>(-0.25 * 2e8, 0.25 * 6e8));
      const complex<double> exact = sum * std::polar(1.0, 2.0 * r * entry) / pi;
      EXPECT_LT(std::abs(A[static_cast<std::size_t>(r)](0, 0) - exact), 1e-13 * 6e8) << immersion << ", harmonic " << r;
    }
  }
}

TEST(DirectionalHarmonics, OfATwoToothSlotEndWithTheFirst) {
  const auto A = directional_harmonics(benchmark_process(1.0), 6);
  EXPECT_GT(A[1].norm(), 0.1 * A[0].norm());
  for (std::size_t r = 2; r < A.size(); ++r) EXPECT_LT(A[r].norm(), 1e-13 * A[0].norm()) << r;
}

TEST(DirectionalHarmonics, RefuseUnequalTeeth) {
  MillingProcess process = benchmark_process(0.1);
  process.cutter.pitches_rad = {3.0, 2.0 * pi - 3.0};
  EXPECT_THROW((void)directional_harmonics(process, 2), core::InputError);
}

TEST(ZerothOrder, MinimaOfTheBenchmark) {
  // Computed outside of this project, all digits that are given.
  const double half_digit = 0.5e-9;
  const std::vector<std::pair<double, double>> down{{1.0, 0.298054e-3}, {0.1, 0.999442e-3}, {0.05, 1.791579e-3}};
  const std::vector<std::pair<double, double>> up{{1.0, 0.298054e-3}, {0.1, 0.753006e-3}, {0.05, 1.489304e-3}};
  for (const auto& [immersion, depth] : down) {
    const auto found = zeroth_order_minimum(benchmark_structure(), benchmark_process(immersion));
    EXPECT_NEAR(found.depth_m, depth, half_digit) << immersion;
  }
  for (const auto& [immersion, depth] : up) {
    const auto found = zeroth_order_minimum(benchmark_structure(), benchmark_process(immersion, MillingDirection::up));
    EXPECT_NEAR(found.depth_m, depth, half_digit) << immersion;
  }
}

TEST(ZerothOrder, MinimumOfOneModeIsTheClosedForm) {
  // w A_xx/k = 2ζ(1 + ζ) at ω = ω_n √(1 + 2ζ), if A_xx > 0.
  const MillingProcess process = benchmark_process(0.3);
  const double A_xx = directional_harmonics(process, 0).front()(0, 0).real();
  const double omega_n = 2.0 * pi * 922.0;
  const auto found = zeroth_order_minimum(benchmark_structure(), process);
  const double sign = A_xx > 0.0 ? 1.0 : -1.0;  // of a negative one the receptance's other extremum is the limit
  const double zeta = 0.011;
  EXPECT_NEAR(found.depth_m * std::abs(A_xx) / (0.03993 * omega_n * omega_n), 2.0 * zeta * (1.0 + sign * zeta), 1e-14);
  EXPECT_NEAR(found.omega_rad_s / omega_n, std::sqrt(1.0 + sign * 2.0 * zeta), 1e-7);
}

TEST(ZerothOrder, TurningIsTheClosedForm) {
  // As in lobes_test.cpp: a constant K along x with delay T.
  const double zeta = 0.02, r = 1.05, hz = 150.0, mass = 0.8;
  const double stiffness = mass * std::pow(2.0 * pi * hz, 2);
  MillingProcess process;
  process.cutter = {4, 0.01};
  process.coefficients = {0.0, 3e8, 0.0, 0.0, 0.0, 0.0};
  process.engagement = {0.0, 2.0 * pi};
  const RelativeStructure structure =
      relative_structure(modal_model({{hz, zeta, mass, Eigen::Vector3d::UnitX()}}), "P");
  const double depth = stiffness * (std::pow(1.0 - r * r, 2) + 4.0 * zeta * zeta * r * r) / (2.0 * (r * r - 1.0)) / 6e8;
  for (const int j : {1, 2, 3}) {
    const double delay_rate = hz * r * pi / (j * pi - std::atan((r * r - 1.0) / (2.0 * zeta * r)));
    const CutAtSpeed cut = cut_at_speed(structure, process, delay_rate * 15.0);
    StabilityOptions options;
    options.depth_limit_m = 0.05;
    const FoundCrossings found = zeroth_order_crossings(cut, 4, options);
    ASSERT_FALSE(found.points.empty());
    EXPECT_NEAR(found.points.front().depth_m / depth, 1.0, 1e-12) << "lobe " << j;
    EXPECT_NEAR(found.points.front().chatter_frequency_hz, r * hz, 1e-9 * hz) << "lobe " << j;
    EXPECT_LT(found.points.front().error_estimate, 1e-9) << "the mean is the whole of it";
  }
}

TEST(ZerothOrder, LobesAtAFrequencyAreCrossingsAtTheirSpeed) {
  const RelativeStructure structure = relative_structure(modal_model(two_directions), "P");
  const MillingProcess process = wall_cut(3e-3);
  StabilityOptions options;
  options.follow = 1e9;
  options.depth_limit_m = 2.5e-3;
  int compared = 0;
  for (const ZerothOrderPoint& point : zeroth_order_boundary(structure, process, 2.0 * pi * 800.0)) {
    if (point.depth_m > 2e-3) continue;
    for (const int lobe : {0, 4}) {
      const double rpm = lobe_speed_rpm(point, lobe, process.cutter.teeth);
      if (rpm < 500.0 || rpm > 60000.0) continue;
      const CutAtSpeed cut = cut_at_speed(structure, process, rpm);
      const FoundCrossings found = zeroth_order_crossings(cut, 0, options);
      const bool known = std::any_of(found.points.begin(), found.points.end(), [&](const LobePoint& p) {
        return std::abs(p.depth_m / point.depth_m - 1.0) < 1e-8 &&
               std::abs(p.chatter_frequency_hz * 2.0 * pi / point.omega_rad_s - 1.0) < 1e-9;
      });
      EXPECT_TRUE(known) << point.omega_rad_s / 2.0 / pi << " Hz, lobe " << lobe << ", " << rpm << " rpm, "
                         << point.depth_m;
      ++compared;
    }
  }
  EXPECT_GT(compared, 40);
}

TEST(ZerothOrder, MultiplierOfTheMeanCutIsOneOnItsBoundary) {
  // The closed form against collocation of the same constant cut.
  const RelativeStructure structure = relative_structure(modal_model(two_directions), "P");
  const MillingProcess process = wall_cut(3e-3);
  const auto mean = directional_harmonics(process, 0);
  StabilityOptions sharp;
  sharp.error_tolerance = 1e-9;
  for (const double rpm : {1500.0, 2400.0, 3300.0, 7000.0}) {
    const CutAtSpeed cut = cut_at_speed(structure, process, rpm);
    const FoundCrossings found = zeroth_order_crossings(cut, 0, {});
    ASSERT_FALSE(found.points.empty());
    const LobePoint& first = found.points.front();
    const Multiplier mu = harmonic_multiplier(cut, mean, first.depth_m, sharp);
    EXPECT_NEAR(mu.modulus, 1.0, 1e-8) << rpm;
    EXPECT_NEAR(mu.chatter_frequency_hz, first.chatter_frequency_hz, 1e-5 * first.chatter_frequency_hz) << rpm;
    EXPECT_EQ(first.unstable_change, 2);
  }
}

TEST(ZerothOrder, IsExactWhereAHelixFillsAWholePitch) {
  // At w = k πD/(z tan β) every moment has the same teeth in the cut along the edge: A is constant.
  const RelativeStructure structure = relative_structure(modal_model(two_directions), "P");
  MillingProcess process = wall_cut(3e-3);
  const double helix = 70.0 * pi / 180.0;
  process.cutter.helices_rad.assign(4, helix);
  const double pitch_m = pi * 0.016 / (4.0 * std::tan(helix));
  const auto mean = directional_harmonics(process, 0);
  StabilityOptions sharp;
  sharp.error_tolerance = 1e-8;
  for (const double rpm : {1500.0, 3300.0, 7000.0}) {
    for (const int k : {1, 2}) {
      const Multiplier exact = multiplier_at(structure, process, rpm, k * pitch_m, sharp);
      const Multiplier found = harmonic_multiplier(cut_at_speed(structure, process, rpm), mean, k * pitch_m, sharp);
      EXPECT_NEAR(found.modulus / exact.modulus, 1.0, 1e-7) << rpm << " rpm, " << k << " pitches";
    }
  }
}

TEST(MultiFrequency, WithoutHarmonicsItIsTheZerothOrderSolution) {
  const RelativeStructure structure = relative_structure(modal_model(two_directions), "P");
  const MillingProcess process = wall_cut(3e-3);
  for (const double rpm : {1500.0, 2400.0, 3300.0, 7000.0}) {
    SCOPED_TRACE(rpm);
    const CutAtSpeed cut = cut_at_speed(structure, process, rpm);
    StabilityOptions options;
    options.follow = 4.0;
    const FoundCrossings closed = zeroth_order_crossings(cut, 0, options);
    const FoundCrossings found = multi_frequency_crossings(cut, 0, options);
    ASSERT_EQ(found.points.size(), closed.points.size());
    for (std::size_t i = 0; i < found.points.size(); ++i) {
      EXPECT_NEAR(found.points[i].depth_m / closed.points[i].depth_m, 1.0, 1e-9);
      EXPECT_NEAR(found.points[i].chatter_frequency_hz, closed.points[i].chatter_frequency_hz, 1e-6);
      EXPECT_EQ(found.points[i].unstable_change, closed.points[i].unstable_change);
    }
  }
}

double first_depth_error(const Reference& row, int harmonics) {
  StabilityOptions options;
  options.follow = 1.0;
  const MillingProcess process = benchmark_process(row.immersion);
  const CutAtSpeed cut = cut_at_speed(benchmark_structure(), process, row.rpm);
  const FoundCrossings found = multi_frequency_crossings(cut, harmonics, options);
  if (found.points.empty()) return 1.0;
  EXPECT_EQ(found.points.front().kind, row.bifurcation());
  return std::abs(found.points.front().depth_m / row.depth_m - 1.0);
}

TEST(MultiFrequency, ConvergesToTheExactDepthsWithThirdOrder) {
  // The directional matrix jumps where the tooth enters or leaves, so that its harmonics fall as 1/r; what is left out
  // acts by going to ω_r and back, A_r G(ω_r) A_{−r} with G ~ 1/r²: the sum over r > h of 1/r⁴ falls as 1/h³.
  for (const Reference& row : references("wcrit_mm")) {
    if (row.immersion == 1.0) continue;
    SCOPED_TRACE(row.where());
    const double coarse = first_depth_error(row, 16);
    const double fine = first_depth_error(row, 32);
    EXPECT_NEAR(std::log2(coarse / fine), 3.0, 0.3);
    EXPECT_LT(fine, 2e-4);
  }
}

TEST(MultiFrequency, TwoToothSlotNeedsOneHarmonicAndTheReach) {
  for (const Reference& row : references("wcrit_mm")) {
    if (row.immersion != 1.0) continue;
    SCOPED_TRACE(row.where());
    // One harmonic is the whole cut. A second adds one to the reach of the motion, and that is all it does.
    EXPECT_LT(first_depth_error(row, 1), 1e-6);
    EXPECT_LT(first_depth_error(row, 2), 2e-9);  // the table's own digits
  }
}

TEST(MultiFrequency, TwoDirectionsConvergeToTheDirectMethod) {
  const RelativeStructure structure = relative_structure(modal_model(two_directions), "P");
  const MillingProcess process = wall_cut(1e-3);
  for (const double rpm : {2400.0, 3300.0, 7000.0}) {
    SCOPED_TRACE(rpm);
    StabilityOptions options;
    options.follow = 3.0;
    options.error_tolerance = 1e-6;
    const LobeRow exact = limiting_depth(structure, process, rpm, options);
    const FoundCrossings found = multi_frequency_crossings(cut_at_speed(structure, process, rpm), 24, options);
    ASSERT_EQ(found.points.size(), exact.crossings.size());
    for (std::size_t i = 0; i < found.points.size(); ++i) {
      const double error = std::abs(found.points[i].depth_m / exact.crossings[i].depth_m - 1.0);
      EXPECT_LT(error, found.points[i].error_estimate + exact.crossings[i].error_estimate);
      EXPECT_LT(error, 1e-3);
      EXPECT_EQ(found.points[i].unstable_change, exact.crossings[i].unstable_change);
      EXPECT_NEAR(found.points[i].chatter_frequency_hz, exact.crossings[i].chatter_frequency_hz, 0.1);
    }
  }
}

TEST(MultiFrequency, TheSlopeOfTheGainBetweenTwoVectorsIsThatOfItsDifferences) {
  constexpr double h = 1e-5;
  const RelativeStructure structure = relative_structure(modal_model(two_directions), "P");
  const MillingProcess process = wall_cut(1e-3);
  const GainOnCircle gain =
      multi_frequency_gain(cut_at_speed(structure, process, 3300.0), directional_harmonics(process, 3), 1e-3);
  Eigen::VectorXcd l(gain.size), r(gain.size);
  for (Eigen::Index i = 0; i < gain.size; ++i) {
    l(i) = std::polar(1.0, 0.7 * static_cast<double>(i));
    r(i) = std::polar(1.0, 1.0 + 0.3 * static_cast<double>(i * i));
  }
  for (const double theta : {0.4, 1.7, 2.9}) {
    const Eigen::MatrixXcd difference = (gain.Z(theta + h) - gain.Z(theta - h)) / (2.0 * h);
    const complex<double> slope = gain.slope(theta, l, r);
    EXPECT_NEAR(std::abs(slope - (l.transpose() * difference * r).value()), 0.0, 1e-6 * std::abs(slope));
  }
}

TEST(MultiFrequency, TheDeterminantAgreesWithCollocationOfTheSameHarmonics) {
  StabilityOptions sharp;
  sharp.error_tolerance = 1e-8;
  sharp.follow = 1.0;
  const MillingProcess process = benchmark_process(0.1);
  for (const double rpm : {8000.0, 12000.0, 16000.0}) {
    const CutAtSpeed cut = cut_at_speed(benchmark_structure(), process, rpm);
    for (const int h : {1, 3}) {
      const FoundCrossings found = multi_frequency_crossings(cut, h, sharp);
      ASSERT_FALSE(found.points.empty());
      const Multiplier mu =
          harmonic_multiplier(cut, directional_harmonics(process, h), found.points.front().depth_m, sharp);
      // What is left is the motion beyond the window of the determinant, and the tolerance.
      EXPECT_NEAR(mu.modulus, 1.0, 5e-8) << rpm << " rpm, " << h;
    }
  }
}

TEST(MultiFrequency, RefusesAToolTooSlowForIt) {
  const MillingProcess process = benchmark_process(0.1);
  const CutAtSpeed cut = cut_at_speed(benchmark_structure(), process, 60.0);
  EXPECT_THROW((void)multi_frequency_crossings(cut, 4, {}), core::InputError);
}

}  // namespace
}  // namespace thinwall::milling::frequency_methods_test

// The periodic motion of a stable cut: harmonic balance, quasi-static limits, marching in time, mean forces in closed
// form.

#include "milling/forced/forced_vibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "core/error.hpp"
#include "milling/cut/cutting_load.hpp"
#include "milling/cut/product_rule.hpp"
#include "milling/direct/stability.hpp"
#include "milling/structure/periodic_motion.hpp"
#include "tests/milling/marching.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::milling::forced_vibration_test {
namespace {

using std::complex;

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180.0;
constexpr double feed = 0.1e-3;

const std::vector<testing::Mode> modes{{500.0, 0.02, 0.05, Eigen::Vector3d::UnitX()},
                                       {700.0, 0.03, 0.08, Eigen::Vector3d::UnitY()}};
const CuttingCoefficients with_edges{6e8, 2e8, 1e8, 2e4, 1.5e4, 1e3};

RelativeStructure structure(const std::vector<testing::Mode>& of = modes) {
  return relative_structure(testing::modal_model(of), "P");
}

MillingProcess process_with(Cutter cutter, double entry_rad, double exit_rad) {
  MillingProcess process;
  process.cutter = std::move(cutter);
  process.coefficients = with_edges;
  process.engagement = {entry_rad, exit_rad};
  return process;
}

ForcedOptions to(double tolerance) {
  ForcedOptions options;
  options.error_tolerance = tolerance;
  return options;
}

/// Force of the one tooth of a cut that stands at φ, by hand.
Eigen::Vector3d tooth_force(const CuttingCoefficients& k, double phi, double depth, double feed_m) {
  const double h = feed_m * std::sin(phi);
  const double tangential = k.K_t * h + k.K_te;
  const double radial = k.K_r * h + k.K_re;
  return depth * Eigen::Vector3d(-tangential * std::cos(phi) - radial * std::sin(phi),
                                 tangential * std::sin(phi) - radial * std::cos(phi), k.K_a * h + k.K_ae);
}

/// Σ_k G(kω) F_k e^{ikωt} of a two-tooth slot. Its force is a sum of e^{imφ}, |m| ≤ 2, cut off at 0 and π, so that F_k
/// is exact: (1/π) ∫₀^π e^{i(m − 2k)φ} dφ.
Eigen::Matrix3Xd slot_by_harmonics(const RelativeStructure& s, const CuttingCoefficients& k, double rpm, double depth,
                                   const Eigen::VectorXd& phi, int harmonics) {
  constexpr int waves = 5;
  Eigen::Matrix<complex<double>, 3, waves> part;  // of e^{imφ}, m = −2 … 2, from as many samples of a turn
  for (int m = -2; m <= 2; ++m) {
    part.col(m + 2).setZero();
    for (int i = 0; i < waves; ++i) {
      const double at = 2.0 * pi * i / waves;
      part.col(m + 2) += tooth_force(k, at, depth, feed).cast<complex<double>>() * std::polar(1.0 / waves, -m * at);
    }
  }
  Eigen::Matrix3Xd q = Eigen::Matrix3Xd::Zero(3, phi.size());
  for (int n = 0; n <= harmonics; ++n) {
    Eigen::Vector3cd F = Eigen::Vector3cd::Zero();
    for (int m = -2; m <= 2; ++m) {
      const int d = m - 2 * n;
      const complex<double> mean = d == 0 ? 1.0 : (std::pow(-1.0, std::abs(d)) - 1.0) / complex<double>(0.0, d * pi);
      F += part.col(m + 2) * mean;
    }
    const Eigen::Vector3cd amplitude = receptance(s, 2.0 * n * rpm * pi / 30.0) * F * (n == 0 ? 1.0 : 2.0);
    for (Eigen::Index i = 0; i < phi.size(); ++i) q.col(i) += (amplitude * std::polar(1.0, 2.0 * n * phi(i))).real();
  }
  return q;
}

TEST(ForcedVibration, OfATwoToothSlotIsTheSumOfItsHarmonics) {
  // Edge forces jump where one tooth follows the other: F_k ~ 1/k, G ~ (ω₀/kω)²; with ω₀/ω ≤ 4.2 what lies beyond 20000
  // harmonics is 4.2²/(2 · 20000²) = 2e-8 of G(0) F.
  const MillingProcess process = process_with({2, 0.01}, 0.0, pi);
  for (const double rpm : {5000.0, 7300.0, 21000.0}) {
    const ForcedVibration v = forced_vibration(structure(), process, rpm, 0.2e-3, feed, to(1e-8));
    EXPECT_EQ(v.status, StabilityStatus::converged);
    EXPECT_NEAR(v.period_s, 30.0 / rpm, 1e-15);
    const Eigen::Index stride = std::max<Eigen::Index>(1, v.rotation_rad.size() / 40);
    const double largest = v.displacement_m.cwiseAbs().maxCoeff();
    Eigen::VectorXd phi(v.rotation_rad.size() / stride);
    for (Eigen::Index i = 0; i < phi.size(); ++i) phi(i) = v.rotation_rad(i * stride);
    const Eigen::Matrix3Xd exact = slot_by_harmonics(structure(), with_edges, rpm, 0.2e-3, phi, 20000);
    for (Eigen::Index i = 0; i < phi.size(); ++i)
      EXPECT_LT((v.displacement_m.col(i * stride) - exact.col(i)).norm(), 1e-7 * largest) << rpm << ' ' << phi(i);
  }
}

TEST(ForcedVibration, EveryFigureIsWithinItsEstimateOfTheFinestGrid) {
  const MillingProcess process =
      process_with({3, 0.012, {100.0 * degree, 120.0 * degree, 140.0 * degree}}, 120.0 * degree, pi);
  const ForcedVibration exact = forced_vibration(structure(), process, 8000.0, 0.3e-3, feed, to(1e-9));
  const double motion = exact.displacement_m.colwise().norm().maxCoeff();
  for (const double tolerance : {1e-3, 1e-5}) {
    const ForcedVibration v = forced_vibration(structure(), process, 8000.0, 0.3e-3, feed, to(tolerance));
    EXPECT_LE(v.error_estimate, tolerance);
    EXPECT_NEAR(v.peak_force_n / exact.peak_force_n, 1.0, v.error_estimate);
    EXPECT_NEAR(v.peak_torque_n_m / exact.peak_torque_n_m, 1.0, v.error_estimate);
    EXPECT_LT((v.peak_to_peak_m - exact.peak_to_peak_m).cwiseAbs().maxCoeff() / motion, v.error_estimate);
    EXPECT_NEAR(*v.surface_location_error_m, *exact.surface_location_error_m, v.error_estimate * motion);
  }
}

TEST(ForcedVibration, NodesConvergeSpectrally) {
  // The force of a slot is sines of 2φ over half a turn: three nodes more gain more than a digit.
  const MillingProcess process = process_with({2, 0.01}, 0.0, pi);
  const RelativeStructure s = structure();
  const CutCycle cycle = cut_cycle(process, 0.2e-3);
  const EdgeShape shape = edge_shape(process.cutter, 0.2e-3);
  const Advance advance = feed_advance(process.cutter, feed);
  const auto tip_at = [&](int nodes, double phi) {
    const ContactGrid grid = contact_grid(process, yielding_directions(s), {1, nodes});
    Eigen::MatrixXd force(3, nodes);
    for (int i = 0; i < nodes; ++i)
      force.col(i) = cutting_load(process.cutter, cycle, shape, 0.2e-3, grid.node_rad(i), advance).force;
    return displacement(periodic_motion(s, grid, 6000.0, force), moment_at(grid, phi));
  };
  const Eigen::Vector3d exact = tip_at(20, 1.3);
  double before = (tip_at(5, 1.3) - exact).norm() / exact.norm();
  for (const int nodes : {8, 11, 14}) {
    const double error = (tip_at(nodes, 1.3) - exact).norm() / exact.norm();
    EXPECT_LT(error, before / 20.0) << nodes;
    before = error;
  }
  EXPECT_LT(before, 1e-7);
}

TEST(ForcedVibration, OfAStiffStructureFollowsTheForce) {
  // A helix lets the force rise from zero without a jump, so that a mode at 60 kHz follows it at G(0) but for the
  // ringing of kinks, (rate of the force)/(ω₀ force), and damping's lag 2ζ/ω₀ of its rate: 1e-3 and less.
  const std::vector<testing::Mode> stiff{{60e3, 0.05, 1e-4, Eigen::Vector3d::UnitX()},
                                         {60e3, 0.05, 2e-4, Eigen::Vector3d::UnitY()}};
  MillingProcess process =
      process_with({3, 0.012, {}, {30.0 * degree, 30.0 * degree, 30.0 * degree}}, 110.0 * degree, pi);
  const ForcedVibration v = forced_vibration(structure(stiff), process, 3000.0, 4e-3, feed);
  const Eigen::Matrix3d G = receptance(structure(stiff), 0.0).real();
  const double largest = v.displacement_m.cwiseAbs().maxCoeff();
  EXPECT_GT(largest, 0.0);
  EXPECT_LT((v.displacement_m - G * v.force_n).cwiseAbs().maxCoeff(), 3e-3 * largest);
}

TEST(SurfaceLocationError, OfAStiffStructureIsTheForceOnTheHeightsAbove) {
  // Down-milling: when a height leaves at φ = π those above it, up to the arc's lag, still cut. Their force towards
  // the tool's centre side times G(0) is the error, summed here by midpoints.
  const std::vector<testing::Mode> stiff{{60e3, 0.05, 2e-4, Eigen::Vector3d::UnitY()}};
  const double depth = 4e-3;
  const double helix = 30.0 * degree;
  const double entry = 110.0 * degree;
  const MillingProcess process = process_with({3, 0.012, {}, {helix, helix, helix}}, entry, pi);
  const ForcedVibration v = forced_vibration(structure(stiff), process, 3000.0, depth, feed);
  const double G = receptance(structure(stiff), 0.0)(1, 1).real();
  ASSERT_EQ(v.walls.size(), 1U);
  EXPECT_EQ(v.walls[0].side, -1);
  const double lag = 2.0 * std::tan(helix) / 0.012;
  double largest = 0.0;
  for (Eigen::Index i = 0; i < v.walls[0].height_m.size(); ++i) {
    const double z = v.walls[0].height_m(i);
    constexpr int slices = 2000;
    double f_y = 0.0;
    for (int s = 0; s < slices; ++s) {
      const double above = (s + 0.5) * (depth - z) / slices;
      const double phi = pi - lag * above;
      if (phi < entry) continue;
      CuttingCoefficients k = with_edges;
      for (double* edge : {&k.K_te, &k.K_re, &k.K_ae}) *edge /= std::cos(helix);
      f_y += tooth_force(k, phi, (depth - z) / slices, feed).y();
    }
    largest = std::max(largest, G * f_y);
    EXPECT_NEAR(v.walls[0].error_m(i), -G * f_y, 3e-3 * v.peak_to_peak_m.y()) << z;
  }
  // The force pushes the tool off the wall: material is left.
  EXPECT_NEAR(*v.surface_location_error_m, -largest, 3e-3 * v.peak_to_peak_m.y());
}

TEST(SurfaceLocationError, UpMillingPullsTheToolIntoTheWallAndDownMillingPushesItOff) {
  // Below the resonance (Schmitz & Smith 2009, ch. 5): up-milling overcuts, down-milling undercuts. The entry of a
  // straight tooth sees what the tooth before has left; with many teeth in a large arc the force is nearly steady.
  const Cutter cutter{6, 0.012};
  const std::vector<testing::Mode> stiff{{8e3, 0.1, 1e-2, Eigen::Vector3d::UnitY()}};
  for (const auto direction : {MillingDirection::up, MillingDirection::down}) {
    MillingProcess process = process_with(cutter, 0.0, 1.0);
    process.engagement = engagement_of(cutter, 8e-3, direction);
    process.coefficients.K_re = process.coefficients.K_te = 0.0;
    const ForcedVibration v = forced_vibration(structure(stiff), process, 2000.0, 1e-3, feed);
    ASSERT_EQ(v.walls.size(), 1U);
    const bool up = direction == MillingDirection::up;
    EXPECT_EQ(v.walls[0].side, up ? 1 : -1);
    EXPECT_EQ(*v.surface_location_error_m > 0.0, up);
    EXPECT_EQ(v.mean_force_n.y() > 0.0, true);
  }
  EXPECT_EQ(forced_vibration(structure(), process_with({2, 0.01}, 0.0, pi), 5000.0, 1e-4, feed).walls.size(), 2U);
  const ForcedVibration inside = forced_vibration(structure(), process_with({2, 0.01}, 0.5, 2.0), 5000.0, 1e-4, feed);
  EXPECT_TRUE(inside.walls.empty());
  EXPECT_FALSE(inside.surface_location_error_m.has_value());
}

void expect_as_marched(const MillingProcess& process, double rpm, double depth, int steps, double tolerance) {
  // After 130 turns less than 1e-7 of the start is left.
  ASSERT_LT(multiplier_at(structure(), process, rpm, depth, {}).modulus, 0.88);
  const ForcedVibration v = forced_vibration(structure(), process, rpm, depth, feed, to(0.1 * tolerance));
  EXPECT_EQ(v.status, StabilityStatus::converged);
  const auto marched = testing::Marching(process, modes, rpm, depth, steps).last_turn_fed(feed, 130);
  const double largest = v.displacement_m.colwise().norm().maxCoeff();
  const double step = 2.0 * pi / steps;
  double worst = 0.0;
  for (Eigen::Index i = 0; i < v.rotation_rad.size(); ++i) {
    // The marched motion between its steps: a cubic through the four nearest (1e-6 off where the force jumps).
    const double at = v.rotation_rad(i) / step;
    const auto first = static_cast<int>(std::floor(at)) - 1;
    Eigen::Vector3d q = Eigen::Vector3d::Zero();
    const Eigen::VectorXd weight = lagrange_polynomials(Eigen::Vector4d(0.0, 1.0, 2.0, 3.0), at - first);
    for (int k = 0; k < 4; ++k) q += weight(k) * marched[static_cast<std::size_t>((first + k + steps) % steps)];
    worst = std::max(worst, (v.displacement_m.col(i) - q).norm());
  }
  EXPECT_LT(worst, tolerance * largest);
}

TEST(ForcedVibration, WithUnequalPitchesAgainstMarchingInTime) {
  expect_as_marched(
      process_with({4, 0.012, {80.0 * degree, 100.0 * degree, 70.0 * degree, 110.0 * degree}}, 0.0, 60.0 * degree),
      10000.0, 0.1e-3, 1800, 1e-6);
}

TEST(ForcedVibration, WithUnequalHelicesAgainstMarchingInTime) {
  expect_as_marched(process_with({2, 0.012, {}, {20.0 * degree, 35.0 * degree}}, 100.0 * degree, pi), 9000.0, 0.35e-3,
                    1440, 1e-4);
}

TEST(ForcedVibration, WithProcessDampingAgainstMarchingInTime) {
  MillingProcess process = process_with({2, 0.01}, 100.0 * degree, pi);
  process.damping = {2e4, 0.3};
  expect_as_marched(process, 6000.0, 0.2e-3, 1800, 1e-5);
}

TEST(ForcedVibration, NearlyEqualTeethOverATurnMoveAsEqualOnesOverAPitch) {
  // Equal teeth do not regenerate; unequal ones are solved with their modulation. A pitch that is off by 1e-7 of a
  // radian moves a resonance of 1/2ζ = 25 by 25 times that at most.
  const double p = 0.5 * pi;
  const double off = 1e-7;
  const MillingProcess equal = process_with({4, 0.012}, 10.0 * degree, 180.0 * degree);
  const MillingProcess unequal =
      process_with({4, 0.012, {p + off, p - off, p + off, p - off}}, 10.0 * degree, 180.0 * degree);
  const ForcedVibration a = forced_vibration(structure(), equal, 6000.0, 0.2e-3, feed, to(1e-7));
  const ForcedVibration b = forced_vibration(structure(), unequal, 6000.0, 0.2e-3, feed, to(1e-7));
  const double largest = a.displacement_m.cwiseAbs().maxCoeff();
  EXPECT_NEAR(b.period_s / a.period_s, 4.0, 1e-12);
  EXPECT_NEAR(b.peak_force_n / a.peak_force_n, 1.0, 3e-6);
  EXPECT_NEAR(b.peak_torque_n_m / a.peak_torque_n_m, 1.0, 3e-6);
  EXPECT_NEAR(b.mean_torque_n_m / a.mean_torque_n_m, 1.0, 3e-6);
  EXPECT_LT((b.peak_to_peak_m - a.peak_to_peak_m).norm(), 5e-6 * largest);
  EXPECT_NEAR(*b.surface_location_error_m, *a.surface_location_error_m, 5e-6 * largest);
}

TEST(ForcedVibration, TorqueIsTheTangentialForceTimesTheRadius) {
  // One tooth at a time: force and torque come from different sums, with regeneration and rubbing flanks in both.
  MillingProcess process =
      process_with({3, 0.012, {100.0 * degree, 120.0 * degree, 140.0 * degree}}, 90.0 * degree, pi);
  process.damping = {2e4, 0.3};
  const ForcedVibration v = forced_vibration(structure(), process, 8000.0, 0.5e-3, feed, to(1e-8));
  const double entry[] = {0.0, 120.0 * degree, 260.0 * degree};
  double worst = 0.0;
  for (Eigen::Index i = 0; i < v.rotation_rad.size(); ++i) {
    double expected = 0.0;
    for (const double e : entry) {
      const double phi = 90.0 * degree + v.rotation_rad(i) - e;
      if (phi < 90.0 * degree - 1e-9 || phi > pi + 1e-9) continue;
      expected -= 0.006 * v.force_n.col(i).dot(Eigen::Vector3d(std::cos(phi), -std::sin(phi), 0.0));
    }
    worst = std::max(worst, std::abs(v.torque_n_m(i) - expected));
  }
  EXPECT_GT(v.peak_torque_n_m, 0.1);
  EXPECT_LT(worst, 1e-7 * v.peak_torque_n_m);
}

TEST(ForcedVibration, MeanForcesOfASlotAreTheClosedForms) {
  // Budak, Altintas & Armarego 1996, average forces of a slot (entry 0, exit π): F_x = −z w/4 K_r f − z w/π K_re, F_y =
  // z w/4 K_t f + z w/π K_te, F_z = z w/π K_a f + z w/2 K_ae; a helix changes the length of the edge alone.
  const CuttingCoefficients& k = with_edges;
  const double w = 1e-4;
  for (const int z : {2, 3}) {
    for (const double helix : {0.0, 30.0 * degree}) {
      Cutter cutter{z, 0.01};
      cutter.helices_rad.assign(static_cast<std::size_t>(z), helix);
      const ForcedVibration v = forced_vibration(structure(), process_with(cutter, 0.0, pi), 6000.0, w, feed, to(1e-7));
      const double edge = 1.0 / std::cos(helix);
      const Eigen::Vector3d expected =
          z * w *
          Eigen::Vector3d(-k.K_r * feed / 4.0 - edge * k.K_re / pi, k.K_t * feed / 4.0 + edge * k.K_te / pi,
                          k.K_a * feed / pi + edge * k.K_ae / 2.0);
      EXPECT_LT((v.mean_force_n - expected).norm(), 1e-7 * expected.norm());
      const double torque = 0.005 * z * w * (k.K_t * feed / pi + edge * k.K_te / 2.0);
      EXPECT_NEAR(v.mean_torque_n_m / torque, 1.0, 1e-7);
      EXPECT_NEAR(v.mean_power_w / (torque * 6000.0 * pi / 30.0), 1.0, 1e-7);
    }
  }
}

TEST(ForcedVibration, PeaksOfOneStraightToothAreTheClosedForms) {
  // Two teeth in a slot: the resultant of one edge, w √((K_t h + K_te)² + …) is largest at φ = π/2; so is the torque.
  const CuttingCoefficients& k = with_edges;
  const double w = 2e-4;
  const ForcedVibration v = forced_vibration(structure(), process_with({2, 0.01}, 0.0, pi), 6000.0, w, feed, to(1e-8));
  const double expected = w * std::hypot(k.K_t * feed + k.K_te, k.K_r * feed + k.K_re, k.K_a * feed + k.K_ae);
  EXPECT_NEAR(v.peak_force_n / expected, 1.0, 1e-8);
  EXPECT_NEAR(v.peak_torque_n_m / (w * 0.005 * (k.K_t * feed + k.K_te)), 1.0, 1e-8);
}

TEST(ForcedVibration, TwiceTheFeedWithoutEdgeForcesMovesTwiceAsFar) {
  MillingProcess process =
      process_with({3, 0.012, {100.0 * degree, 120.0 * degree, 140.0 * degree}}, 120.0 * degree, pi);
  process.coefficients = {6e8, 2e8, 1e8, 0.0, 0.0, 0.0};
  const ForcedVibration one = forced_vibration(structure(), process, 8000.0, 0.5e-3, feed);
  const ForcedVibration two = forced_vibration(structure(), process, 8000.0, 0.5e-3, 2.0 * feed);
  ASSERT_EQ(one.rotation_rad.size(), two.rotation_rad.size());
  EXPECT_LT((two.displacement_m - 2.0 * one.displacement_m).norm(), 1e-11 * two.displacement_m.norm());
  EXPECT_NEAR(*two.surface_location_error_m / *one.surface_location_error_m, 2.0, 1e-10);
  EXPECT_NEAR(two.peak_torque_n_m / one.peak_torque_n_m, 2.0, 1e-10);
}

TEST(ForcedVibration, ResidualAnswersAtOnce) {
  // A mode at 60 kHz is worth its static compliance.
  const std::vector<testing::Mode> with{modes[0], modes[1], {60e3, 0.1, 1e-5, Eigen::Vector3d::UnitY()}};
  RelativeStructure residual = structure();
  residual.R(1, 1) = 1.0 / (1e-5 * std::pow(2.0 * pi * 60e3, 2));
  const MillingProcess process = process_with({2, 0.01}, 100.0 * degree, pi);
  const ForcedVibration a = forced_vibration(structure(with), process, 4000.0, 0.2e-3, feed);
  const ForcedVibration b = forced_vibration(residual, process, 4000.0, 0.2e-3, feed);
  const ForcedVibration none = forced_vibration(structure(), process, 4000.0, 0.2e-3, feed);
  const double off = std::abs(*b.surface_location_error_m - *none.surface_location_error_m);
  EXPECT_GT(off, 0.0);
  EXPECT_LT(std::abs(*a.surface_location_error_m - *b.surface_location_error_m), 0.01 * off);
}

// Of unequal teeth, too, whose force hangs on the motion.
TEST(ForcedVibration, WithoutTheMotionForceAndSurfaceAreTheSame) {
  ForcedOptions lean = to(1e-6);
  lean.motion = false;
  Cutter uneven{2, 0.01};
  uneven.pitches_rad = {2.8, 2.0 * pi - 2.8};
  for (const Cutter& cutter : {Cutter{2, 0.01}, uneven}) {
    const MillingProcess process = process_with(cutter, 0.5, pi);
    const ForcedVibration all = forced_vibration(structure(), process, 7000.0, 0.1e-3, feed, to(1e-6));
    const ForcedVibration v = forced_vibration(structure(), process, 7000.0, 0.1e-3, feed, lean);
    EXPECT_EQ(v.displacement_m.size(), 0);
    EXPECT_NEAR(v.peak_force_n, all.peak_force_n, 3e-6 * all.peak_force_n);
    EXPECT_NEAR(*v.surface_location_error_m, *all.surface_location_error_m, 3e-6 * all.peak_to_peak_m.norm());
  }
}

TEST(ForcedVibration, WhatItDoesNotModelIsRefused) {
  const auto refused = [](const MillingProcess& process, double rpm, double depth, double feed_m, const char* word) {
    try {
      (void)forced_vibration(structure(), process, rpm, depth, feed_m);
      ADD_FAILURE() << word;
    } catch (const core::InputError& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  };
  const MillingProcess good = process_with({2, 0.01}, 0.0, pi);
  refused(good, 5000.0, 1e-3, 0.0, "feed per tooth 0");
  refused(good, 5000.0, 1e-3, std::nan(""), "feed per tooth");
  refused(good, 5000.0, -1e-3, feed, "depth of cut");
  refused(good, 0.0, 1e-3, feed, "spindle speed");
  refused(process_with({2, 0.01}, 0.5, 4.0), 5000.0, 1e-3, feed, "behind the tool");
  Cutter runout{2, 0.01};
  runout.runout_m = {0.0, 5e-6};
  refused(process_with(runout, 0.0, pi), 5000.0, 1e-3, feed, "runout");
  EXPECT_EQ(validate(ForcedOptions{0.0, 2}).size(), 2U);
}

}  // namespace
}  // namespace thinwall::milling::forced_vibration_test

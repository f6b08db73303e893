// The two-DOF benchmark of Insperger & Stepan (2004) and Ding et al. (2010), the case cases/ding-2010, by another way:
// a pseudospectral (Chebyshev) collocation of the states over the cut with the entry and the exit as its ends, and the
// matrix exponential of the free flight.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <unsupported/Eigen/MatrixFunctions>

#include "core/dense_eigenvalues.hpp"
#include "core/dense_factorisations.hpp"
#include "milling/direct/stability.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::milling::two_dof_benchmark_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double omega = 2.0 * pi * 922.0;
constexpr double zeta = 0.011;
constexpr double mass = 0.03993;
constexpr double K_t = 6e8;
constexpr double K_n = 2e8;

/// Derivatives at the points −cos(πi/n) of the polynomial through values there (Trefethen 2000, chapter 6).
Eigen::MatrixXd chebyshev(int n, Eigen::VectorXd& x) {
  x = (-(Eigen::ArrayXd::LinSpaced(n + 1, 0.0, pi)).cos()).matrix();
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(n + 1, n + 1);
  const auto c = [&](int i) { return (i == 0 || i == n ? 2.0 : 1.0) * (i % 2 == 0 ? 1.0 : -1.0); };
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      if (i != j) D(i, j) = c(i) / c(j) / (x(i) - x(j));
    }
    D(i, i) = -D.row(i).sum();
  }
  return D;
}

/// Dominant |μ| of x'' + 2ζω x' + ω² x = −(w/m) h(φ) [x(t) − x(t−T)], x in the plane, two teeth, h of one tooth as in
/// Insperger & Stepan (2004): h = (K_t [cos; −sin] + K_n [sin; cos]) [sin cos].
double modulus(double immersion, bool down, double rpm, double depth, int n) {
  const double entry = down ? std::acos(2.0 * immersion - 1.0) : 0.0;
  const double exit = down ? pi : std::acos(1.0 - 2.0 * immersion);
  const double turn = rpm * pi / 30.0;
  const double cut = (exit - entry) / turn;
  Eigen::VectorXd x;
  Eigen::MatrixXd D = chebyshev(n, x) * (2.0 / cut);
  Eigen::Matrix4d free = Eigen::Matrix4d::Zero();
  free.topRightCorner<2, 2>() = omega * Eigen::Matrix2d::Identity();  // velocities over ω, for the sake of round-off
  free.bottomLeftCorner<2, 2>() = -omega * Eigen::Matrix2d::Identity();
  free.bottomRightCorner<2, 2>() = -2.0 * zeta * omega * Eigen::Matrix2d::Identity();
  const int points = n + 1;
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(4 * points, 4 * points);
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(4 * points, 4 + 2 * points);  // state at entry, displacements a period ago
  for (int i = 0; i < points; ++i) {
    if (i == 0) {
      M.topLeftCorner<4, 4>().setIdentity();
      R.topLeftCorner<4, 4>().setIdentity();
      continue;
    }
    const double phi = entry + 0.5 * (x(i) + 1.0) * (exit - entry);
    const double s = std::sin(phi);
    const double c = std::cos(phi);
    const Eigen::Matrix2d h = Eigen::Vector2d(K_t * c + K_n * s, -K_t * s + K_n * c) * Eigen::RowVector2d(s, c);
    for (int j = 0; j < points; ++j) M.block<4, 4>(4 * i, 4 * j) = D(i, j) * Eigen::Matrix4d::Identity();
    M.block<4, 4>(4 * i, 4 * i) -= free;
    M.block<2, 2>(4 * i + 2, 4 * i) += depth / (mass * omega) * h;
    R.block<2, 2>(4 * i + 2, 4 + 2 * i) = depth / (mass * omega) * h;
  }
  const Eigen::MatrixXd states = M.partialPivLu().solve(R);
  const double period = 30.0 / rpm;
  Eigen::MatrixXd map(4 + 2 * points, 4 + 2 * points);
  map.topRows<4>() = Eigen::Matrix4d(free * (period - cut)).exp() * states.bottomRows<4>();
  for (int i = 0; i < points; ++i) map.middleRows<2>(4 + 2 * i) = states.middleRows<2>(4 * i);
  return map.eigenvalues().cwiseAbs().maxCoeff();
}

MillingProcess benchmark(MillingDirection direction) {
  MillingProcess process;
  process.cutter = {2, 0.01};
  process.coefficients = {K_t, K_n, 0.0, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, 1e-3, direction);
  return process;
}

TEST(TwoDofBenchmark, LimitingDepthsLieOnTheCircleOfAnotherCollocation) {
  const RelativeStructure structure =
      relative_structure(testing::modal_model({{922.0, zeta, mass, Eigen::Vector3d::UnitX()},
                                               {922.0, zeta, mass, Eigen::Vector3d::UnitY()}}),
                         "P");
  StabilityOptions options;
  options.error_tolerance = 1e-8;
  options.follow = 1.0;
  for (const double rpm : {5000.0, 8000.0, 12000.0, 16000.0, 20000.0, 25000.0}) {
    SCOPED_TRACE(rpm);
    for (const bool down : {true, false}) {
      const MillingProcess process = benchmark(down ? MillingDirection::down : MillingDirection::up);
      const LobeRow row = limiting_depth(structure, process, rpm, options);
      ASSERT_EQ(row.status, StabilityStatus::converged);
      const double depth = row.limiting_depth_m;
      const auto at = [&](double share, int n) { return modulus(0.1, down, rpm, share * depth, n); };
      EXPECT_NEAR(at(1.0, 20), at(1.0, 24), 1e-11) << "the other way should have converged";
      const double slope = (at(1.001, 20) - at(0.999, 20)) / 0.002;  // of |μ| with the relative depth
      ASSERT_GT(slope, 0.0);
      EXPECT_NEAR((at(1.0, 20) - 1.0) / slope, 0.0, 1e-9);
      EXPECT_LT(at(0.99, 20), 1.0);
    }
  }
}

}  // namespace
}  // namespace thinwall::milling::two_dof_benchmark_test

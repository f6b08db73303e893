#include "learning/mean_force_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"

namespace thinwall::learning {

namespace {

using Eigen::Index;
using std::numbers::pi;

constexpr double largest_condition = 1e8;

/// Means over a turn of what the coefficients stand before: rows x_T, y_T; columns K_t, K_r, K_te, K_re.
Eigen::Matrix<double, 2, 4> across_axis(int teeth, const MeanForceTest& test) {
  const auto [from, to] = test.engagement;
  const double c = test.feed_per_tooth_m;
  const double ss = 0.5 * (to - from) - 0.25 * (std::sin(2.0 * to) - std::sin(2.0 * from));  // ∫ sin² φ
  const double sc = 0.5 * (std::pow(std::sin(to), 2) - std::pow(std::sin(from), 2));         // ∫ sin φ cos φ
  const double s = std::cos(from) - std::cos(to), k = std::sin(to) - std::sin(from);         // ∫ sin φ, ∫ cos φ
  Eigen::Matrix<double, 2, 4> A;
  A << -c * sc, -c * ss, -k, -s, c * ss, -c * sc, s, -k;
  return teeth * test.depth_m / (2.0 * pi) * A;
}

/// The means along the axis: columns K_a, K_ae.
Eigen::RowVector2d along_axis(int teeth, const MeanForceTest& test) {
  const auto [from, to] = test.engagement;
  const double s = std::cos(from) - std::cos(to);
  return teeth * test.depth_m / (2.0 * pi) * Eigen::RowVector2d(test.feed_per_tooth_m * s, to - from);
}

void require_usable(const std::vector<MeanForceTest>& tests) {
  for (std::size_t i = 0; i < tests.size(); ++i) {
    const MeanForceTest& test = tests[i];
    const bool well = test.depth_m > 0.0 && test.feed_per_tooth_m > 0.0 && test.force_n.allFinite() &&
                      milling::validate(test.engagement).empty();
    if (!well) {
      throw core::InputError("coefficients: test " + std::to_string(i + 1) +
                             " needs a depth and a feed above 0, an engagement and finite forces; correct it");
    }
  }
}

std::string test_to_add(const std::vector<MeanForceTest>& tests) {
  const auto [least, most] = std::ranges::minmax_element(tests, {}, &MeanForceTest::feed_per_tooth_m);
  if (tests.empty() || most->feed_per_tooth_m < 1.05 * least->feed_per_tooth_m)
    return "add one at twice the feed per tooth, which tells edge forces from those of the chip";
  return "add one of another engagement, a slot for instance";
}

/// A least-squares problem with its solution.
struct Solved {
  Eigen::VectorXd x, deviation;
  double residual_square = 0.0, condition = 1.0;
  Index degrees_of_freedom = 0;
};

Solved solve(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, const std::vector<MeanForceTest>& tests) {
  const Eigen::VectorXd length = A.colwise().norm();
  const Eigen::MatrixXd scaled = A * length.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(Eigen::MatrixXd(scaled.transpose() * scaled));
  const Eigen::VectorXd values = eigen.eigenvalues();
  Solved solved;
  solved.condition = std::sqrt(values(values.size() - 1) / std::max(values(0), 1e-300));
  if (A.rows() < A.cols() || !(solved.condition < largest_condition)) {
    std::ostringstream text;
    text << "coefficients: " << tests.size() << " tests do not tell them apart (condition " << solved.condition
         << ", must be below " << largest_condition << "); " << test_to_add(tests);
    throw core::InputError(text.str());
  }
  const Eigen::MatrixXd inverse =
      eigen.eigenvectors() * values.cwiseInverse().asDiagonal() * eigen.eigenvectors().transpose();
  Eigen::VectorXd y = inverse * (scaled.transpose() * b);
  y += inverse * (scaled.transpose() * (b - scaled * y));  // takes off what squaring the condition cost
  solved.x = y.cwiseQuotient(length);
  solved.residual_square = (b - scaled * y).squaredNorm();
  solved.degrees_of_freedom = A.rows() - A.cols();
  const double variance = solved.degrees_of_freedom > 0
                              ? solved.residual_square / static_cast<double>(solved.degrees_of_freedom)
                              : std::numeric_limits<double>::infinity();
  solved.deviation = (variance * inverse.diagonal()).cwiseSqrt().cwiseQuotient(length);
  return solved;
}

FittedCoefficient coefficient_of(const Solved& solved, Index k) {
  const double infinite = std::numeric_limits<double>::infinity();
  if (solved.degrees_of_freedom == 0) return {solved.x(k), infinite, infinite};
  return {solved.x(k), solved.deviation(k),
          solved.deviation(k) * student_quantile(0.975, static_cast<double>(solved.degrees_of_freedom))};
}

}  // namespace

Eigen::Vector3d mean_force_n(int teeth, const milling::CuttingCoefficients& k, const MeanForceTest& test) {
  Eigen::Vector3d force;
  force.head<2>() = across_axis(teeth, test) * Eigen::Vector4d(k.K_t, k.K_r, k.K_te, k.K_re);
  force(2) = along_axis(teeth, test) * Eigen::Vector2d(k.K_a, k.K_ae);
  return force;
}

CoefficientFit fit_mean_forces(int teeth, const std::vector<MeanForceTest>& tests) {
  require_usable(tests);
  if (teeth < 1) throw core::InputError("coefficients: a tool has one tooth at least; correct the number");
  const auto count = std::ssize(tests);
  Eigen::MatrixXd A(2 * count, 4), axial(count, 2);
  Eigen::VectorXd b(2 * count), z(count);
  Eigen::Matrix3Xd forces(3, count);
  for (Index i = 0; i < count; ++i) {
    const MeanForceTest& test = tests[static_cast<std::size_t>(i)];
    A.middleRows<2>(2 * i) = across_axis(teeth, test);
    b.segment<2>(2 * i) = test.force_n.head<2>();
    axial.row(i) = along_axis(teeth, test);
    z(i) = test.force_n(2);
    forces.col(i) = test.force_n;
  }
  const Solved across = solve(A, b, tests), along = solve(axial, z, tests);
  const double residual = across.residual_square + along.residual_square;
  const double scatter = (forces.colwise() - forces.rowwise().mean()).squaredNorm();
  return {coefficient_of(across, 0),
          coefficient_of(across, 1),
          coefficient_of(along, 0),
          coefficient_of(across, 2),
          coefficient_of(across, 3),
          coefficient_of(along, 1),
          scatter > 0.0 ? 1.0 - residual / scatter : 1.0,
          std::sqrt(residual / static_cast<double>(3 * count)),
          across.condition,
          across.degrees_of_freedom};
}

double student_quantile(double share, double n) {
  if (!(share > 0.5 && share < 1.0 && n >= 1.0))
    throw core::InputError("Student's t: the share must lie between 0.5 and 1, the degrees of freedom be 1 at least");
  const double p = 2.0 * (1.0 - share);  // of both tails, as Hill counts
  if (n < 1.5) return 1.0 / std::tan(p * pi / 2.0);
  if (n < 2.5) return std::sqrt(2.0 / (p * (2.0 - p)) - 2.0);
  const double a = 1.0 / (n - 0.5), b = 48.0 / (a * a);
  double c = ((20700.0 * a / b - 98.0) * a - 16.0) * a + 96.36;
  const double d = ((94.5 / (b + c) - 3.0) / b + 1.0) * std::sqrt(a * pi / 2.0) * n;
  double y = std::pow(d * p, 2.0 / n);
  if (y > 0.05 + a) {
    // x: the normal quantile of p/2, by Newton's rule on its own distribution.
    double x = -2.0;
    for (int i = 0; i < 30; ++i)
      x -= (0.5 * std::erfc(-x / std::numbers::sqrt2) - 0.5 * p) * std::sqrt(2.0 * pi) * std::exp(0.5 * x * x);
    y = x * x;
    if (n < 5.0) c += 0.3 * (n - 4.5) * (x + 0.6);
    c = (((0.05 * d * x - 5.0) * x - 7.0) * x - 2.0) * x + b + c;
    y = (((((0.4 * y + 6.3) * y + 36.0) * y + 94.5) / c - y - 3.0) / b + 1.0) * x;
    y = std::expm1(a * y * y);
  } else {
    y = ((1.0 / (((n + 6.0) / (n * y) - 0.089 * d - 0.822) * (n + 2.0) * 3.0) + 0.5 / (n + 4.0)) * y - 1.0) *
            (n + 1.0) / (n + 2.0) +
        1.0 / y;
  }
  return std::sqrt(n * y);
}

}  // namespace thinwall::learning

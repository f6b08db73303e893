#include "learning/mean_force_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

#include "core/error.hpp"

namespace thinwall::learning {

namespace {

using Eigen::Index;
using std::numbers::pi;

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

/// linear_fit(), refused where the tests do not tell the coefficients apart.
LinearFit solve(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, const std::vector<MeanForceTest>& tests) {
  LinearFit fit = linear_fit(A, b);
  if (fit.condition < largest_condition) return fit;
  std::ostringstream text;
  text << "coefficients: " << tests.size() << " tests do not tell them apart (condition " << fit.condition
       << ", must be below " << largest_condition << "); " << test_to_add(tests);
  throw core::InputError(text.str());
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
  const LinearFit across = solve(A, b, tests), along = solve(axial, z, tests);
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

}  // namespace thinwall::learning

#include "learning/linear_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"

namespace thinwall::learning {

using Eigen::Index;
using std::numbers::pi;

LinearFit linear_fit(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const Eigen::VectorXd length = A.colwise().norm();
  LinearFit fit;
  fit.degrees_of_freedom = A.rows() - A.cols();
  fit.condition = infinite;
  if (fit.degrees_of_freedom < 0 || !(length.minCoeff() > 0.0)) return fit;
  const Eigen::MatrixXd scaled = A * length.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(Eigen::MatrixXd(scaled.transpose() * scaled));
  const Eigen::VectorXd& values = eigen.eigenvalues();
  fit.condition = std::sqrt(values(values.size() - 1) / std::max(values(0), 1e-300));
  const Eigen::MatrixXd inverse =
      eigen.eigenvectors() * values.cwiseInverse().asDiagonal() * eigen.eigenvectors().transpose();
  Eigen::VectorXd y = inverse * (scaled.transpose() * b);
  y += inverse * (scaled.transpose() * (b - scaled * y));  // takes off what squaring the condition cost
  fit.x = y.cwiseQuotient(length);
  fit.residual_square = (b - scaled * y).squaredNorm();
  const double variance =
      fit.degrees_of_freedom > 0 ? fit.residual_square / static_cast<double>(fit.degrees_of_freedom) : infinite;
  const Eigen::VectorXd per_length = length.cwiseInverse();
  fit.covariance = variance * (per_length.asDiagonal() * inverse * per_length.asDiagonal());
  fit.deviation = fit.covariance.diagonal().cwiseSqrt();
  return fit;
}

double interval_factor(const LinearFit& fit) {
  if (fit.degrees_of_freedom == 0) return std::numeric_limits<double>::infinity();
  return student_quantile(0.975, static_cast<double>(fit.degrees_of_freedom));
}

FittedCoefficient coefficient_of(const LinearFit& fit, Index k) {
  const double infinite = std::numeric_limits<double>::infinity();
  if (fit.degrees_of_freedom == 0) return {fit.x(k), infinite, infinite};
  return {fit.x(k), fit.deviation(k), fit.deviation(k) * interval_factor(fit)};
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

#include "coupling/kernel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace thinwall::coupling {

namespace {

/// The Skeel condition ‖ D⁻¹ |S⁺| magnitude D ‖_∞ with D = diag(magnitude)^−½; `row_sums` is workspace.
double skeel_condition(const Eigen::MatrixXcd& S_inverse, const Eigen::MatrixXd& magnitude, Eigen::VectorXd& row_sums) {
  const auto root = [&](Eigen::Index i) { return magnitude(i, i) > 0.0 ? std::sqrt(magnitude(i, i)) : 1.0; };
  row_sums.setZero(magnitude.rows());
  for (Eigen::Index j = 0; j < magnitude.cols(); ++j) row_sums += magnitude.col(j) / root(j);
  double largest = 0.0;
  for (Eigen::Index i = 0; i < magnitude.rows(); ++i) {
    double sum = 0.0;
    for (Eigen::Index k = 0; k < magnitude.rows(); ++k) sum += std::abs(S_inverse(i, k)) * row_sums(k);
    sum *= root(i);
    if (!std::isfinite(sum)) return sum;
    largest = std::max(largest, sum);
  }
  return largest;
}

}  // namespace

void Kernel::regularised_inverse(const Eigen::MatrixXcd& S, KernelLine& line) {
  svd_.compute(S, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::VectorXd& sigma = svd_.singularValues();
  const double mu = threshold_ * sigma(0);
  S_inverse_.setZero(S.cols(), S.rows());
  for (Eigen::Index i = 0; i < sigma.size(); ++i) {
    const bool small = !(sigma(i) > mu);
    if (small) ++line.dropped;
    if (sigma(i) == 0.0 || (small && regularisation_ == Regularisation::truncated)) continue;
    const double f =
        regularisation_ == Regularisation::tikhonov ? 1.0 / (sigma(i) + mu * (mu / sigma(i))) : 1.0 / sigma(i);
    S_inverse_.noalias() += f * svd_.matrixV().col(i) * svd_.matrixU().col(i).adjoint();
  }
}

KernelLine Kernel::solve(const Eigen::MatrixXcd& S, const Eigen::MatrixXd& magnitude, const Eigen::MatrixXcd& R) {
  KernelLine line;
  if (regularisation_ == Regularisation::none) {
    if (identity_.rows() != S.rows()) identity_.setIdentity(S.rows(), S.cols());
    lu_.compute(S);
    S_inverse_ = lu_.solve(identity_);
    X_ = lu_.solve(R);
  } else {
    regularised_inverse(S, line);
    X_.noalias() = S_inverse_ * R;
    gap_ = R;
    gap_.noalias() -= S * X_;
    for (Eigen::Index j = 0; j < R.cols(); ++j) {
      const double size = R.col(j).norm();
      if (size > 0.0) line.compatibility_residual = std::max(line.compatibility_residual, gap_.col(j).norm() / size);
    }
  }
  line.condition = skeel_condition(S_inverse_, magnitude, row_sums_);
  // A pivot of zero gives an inverse that is not finite, and a kernel of zeros gives the condition 0.
  if (!(line.condition > 0.0 && std::isfinite(line.condition)))
    line.condition = std::numeric_limits<double>::infinity();
  return line;
}

}  // namespace thinwall::coupling

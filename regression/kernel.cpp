#include "regression/kernel.hpp"

#include <cmath>

namespace thinwall::regression {

namespace {

/// r² of all pairs.
Eigen::MatrixXd squared_distances(const Eigen::MatrixXd& X, const Eigen::MatrixXd& other,
                                  const Eigen::VectorXd& length) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(X.rows(), other.rows());
  for (Eigen::Index d = 0; d < X.cols(); ++d) {
    const Eigen::VectorXd a = X.col(d) / length(d), b = other.col(d) / length(d);
    sum.array() += (a.replicate(1, b.size()) - b.transpose().replicate(a.size(), 1)).array().square();
  }
  return sum;
}

}  // namespace

Eigen::MatrixXd correlation(Kernel kernel, const Eigen::MatrixXd& X, const Eigen::MatrixXd& other,
                            const Eigen::VectorXd& length) {
  return correlation(kernel, squared_distances(X, other, length).array());
}

Eigen::ArrayXXd correlation(Kernel kernel, const Eigen::ArrayXXd& r2) {
  if (kernel == Kernel::squared_exponential) return (-0.5 * r2).exp();
  const Eigen::ArrayXXd s = ((kernel == Kernel::matern_3_2 ? 3.0 : 5.0) * r2).sqrt();
  if (kernel == Kernel::matern_3_2) return (1.0 + s) * (-s).exp();
  return (1.0 + s + s.square() / 3.0) * (-s).exp();
}

Eigen::MatrixXd correlation_change(Kernel kernel, const Eigen::MatrixXd& X, const Eigen::VectorXd& length,
                                   Eigen::Index d) {
  const Eigen::ArrayXXd r2 = squared_distances(X, X, length).array();
  const Eigen::ArrayXXd along = squared_distances(X.col(d), X.col(d), length.segment<1>(d)).array();
  if (kernel == Kernel::squared_exponential) return along * (-0.5 * r2).exp();
  const Eigen::ArrayXXd s = ((kernel == Kernel::matern_3_2 ? 3.0 : 5.0) * r2).sqrt();
  if (kernel == Kernel::matern_3_2) return 3.0 * along * (-s).exp();
  return 5.0 / 3.0 * along * (1.0 + s) * (-s).exp();
}

}  // namespace thinwall::regression

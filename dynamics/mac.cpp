#include "dynamics/mac.hpp"

#include "core/error.hpp"

namespace thinwall::dynamics {

Eigen::MatrixXd mac(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::MatrixXd>& b) {
  if (a.rows() != b.rows())
    throw core::InputError("shapes of " + std::to_string(a.rows()) + " and " + std::to_string(b.rows()) +
                           " rows cannot be compared");
  const auto inverse = [](double size) { return size > 0.0 ? 1.0 / size : 0.0; };
  const Eigen::VectorXd of_a = a.colwise().norm().transpose().unaryExpr(inverse);
  const Eigen::VectorXd of_b = b.colwise().norm().transpose().unaryExpr(inverse);
  return (of_a.asDiagonal() * (a.transpose() * b) * of_b.asDiagonal()).cwiseAbs2();
}

}  // namespace thinwall::dynamics

#pragma once
// Derivatives by differences, the independent way to a Jacobian.

#include <Eigen/Core>
#include <functional>

namespace thinwall::robot {

/// ∂f/∂q by central differences of fourth order: error h⁴, round-off ε/h.
inline Eigen::MatrixXd derivative(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& f,
                                  const Eigen::VectorXd& q) {
  constexpr double h = 1e-3;
  Eigen::MatrixXd J(f(q).size(), q.size());
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const Eigen::VectorXd e = h * Eigen::VectorXd::Unit(q.size(), i);
    J.col(i) = (8.0 * (f(q + e) - f(q - e)) - f(q + 2 * e) + f(q - 2 * e)) / (12.0 * h);
  }
  return J;
}

}  // namespace thinwall::robot

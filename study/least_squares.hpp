#pragma once
// Bounded least squares for a handful of parameters and an expensive function.

#include <Eigen/Core>
#include <functional>

namespace thinwall::study {

/// r(x), x scaled to [0, 1] between the parameters' bounds.
using ResidualsAt = std::function<Eigen::VectorXd(const Eigen::VectorXd& x)>;

/// ∂r/∂x (residuals × parameters) at x, where the residuals are r.
using JacobianAt = std::function<Eigen::MatrixXd(const Eigen::VectorXd& x, const Eigen::VectorXd& r)>;

/// The outcome of the search.
struct [[nodiscard]] LeastSquares {
  Eigen::VectorXd parameters;  ///< scaled
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;
  bool converged = false;
};

/// The Jacobian by forward differences of `difference`, backward where that would leave the range. Cost: an evaluation
/// a parameter.
[[nodiscard]] JacobianAt forward_differences(ResidualsAt r, double difference);

/// Minimises ‖r(x)‖ over 0 ≤ x ≤ 1 by Gauss-Newton steps, the bounds active where the step leaves them. The Jacobian is
/// made once, after r at the start, and then kept up to date by Broyden's rank-one formula (Broyden 1965), so that an
/// iteration costs one evaluation; a step that does not help is halved, at most six times. Ends when a step is below
/// `tolerance` (of the range) or after `most_iterations`.
LeastSquares bounded_least_squares(const ResidualsAt& r, const JacobianAt& jacobian, const Eigen::VectorXd& start,
                                   double tolerance, int most_iterations);

}  // namespace thinwall::study

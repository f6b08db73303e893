#pragma once
// Bounded least squares for a handful of parameters and an expensive function.

#include <Eigen/Core>
#include <functional>

namespace thinwall::app {

/// Where the search ended. `jacobian` (residuals × parameters) belongs to parameters scaled to [0, 1] between their
/// bounds.
struct [[nodiscard]] LeastSquares {
  Eigen::VectorXd parameters;  ///< scaled
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;
  int evaluations = 0;
  bool converged = false;
};

/// Minimises ‖r(x)‖ over 0 ≤ x ≤ 1 by Gauss-Newton steps, the bounds active where the step leaves them. The Jacobian is
/// made once by forward differences of `difference` and then kept up to date by Broyden's rank-one formula (Broyden
/// 1965), so that an iteration costs one evaluation; a step that does not help is halved, at most six times. Ends when
/// a step is below `tolerance` (of the range) or after `most_iterations`.
LeastSquares bounded_least_squares(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& r,
                                   const Eigen::VectorXd& start, double difference, double tolerance,
                                   int most_iterations);

}  // namespace thinwall::app

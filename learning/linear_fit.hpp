#pragma once
// Linear least squares with the uncertainty of the solution.

#include <Eigen/Core>

namespace thinwall::learning {

/// One coefficient with its uncertainty, in its own unit.
struct FittedCoefficient {
  double value = 0.0;
  double deviation = 0.0;      ///< standard
  double half_interval = 0.0;  ///< of 95 %, by Student's t
};

/// The x of least |b − A x|².
struct LinearFit {
  Eigen::VectorXd x;
  Eigen::MatrixXd covariance;  ///< s² (AᵀA)⁻¹, s² = |b − A x|²/degrees_of_freedom; not finite with none
  Eigen::VectorXd deviation;   ///< the roots of its diagonal
  double residual_square = 0.0;
  double condition = 1.0;  ///< of A with columns of one length; infinite with fewer rows than columns
  Eigen::Index degrees_of_freedom = 0;
};

/// The condition beyond which x of linear_fit() is of no use.
constexpr double largest_condition = 1e8;

/// By the normal equations of columns of one length, with a step of refinement, which loses nothing up to
/// largest_condition. Cost O(rows columns²).
[[nodiscard]] LinearFit linear_fit(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// Half the interval of 95 % over the standard deviation, by Student's t; infinite without degrees of freedom.
[[nodiscard]] double interval_factor(const LinearFit& fit);

/// Unknown k of the fit.
[[nodiscard]] FittedCoefficient coefficient_of(const LinearFit& fit, Eigen::Index k);

/// The t for which a share of Student's distribution with that many degrees of freedom lies below, 0.5 < share < 1, by
/// Hill's expansion (1970, CACM algorithm 396), exact for 1 and 2, else to 1e-4. Throws InputError outside.
[[nodiscard]] double student_quantile(double share, double degrees_of_freedom);

}  // namespace thinwall::learning

#pragma once
// The answers of a Gaussian process.

#include <Eigen/Core>
#include <limits>

namespace thinwall::regression {

/// Added to the variance of every observation, so that places that almost coincide can be factorised.
inline constexpr double jitter = 1e-10;

/// The logarithm of the likelihood of the data, and its gradient by packed().
struct Likelihood {
  double value = -std::numeric_limits<double>::infinity();  ///< −∞ where the covariance could not be factorised
  Eigen::VectorXd gradient;                                 ///< empty then
};

/// The function, without noise, at m places. Place-major: the tasks of a place stand together.
struct Prediction {
  Eigen::MatrixXd mean;        ///< m × tasks
  Eigen::MatrixXd covariance;  ///< (m tasks) × (m tasks)
};

/// Each observation from all others, with its noise (Rasmussen & Williams 2006, Eq. 5.12): n × tasks, NaN where nothing
/// was measured.
struct LeaveOneOut {
  Eigen::MatrixXd mean;
  Eigen::MatrixXd variance;
};

}  // namespace thinwall::regression

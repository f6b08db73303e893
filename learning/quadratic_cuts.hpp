#pragma once
// The prediction of cuts as quadratic functions of the parameters, fitted where the posterior lies.

#include <Eigen/Core>

#include "learning/cut_likelihood.hpp"

namespace thinwall::learning {

/// A mean and a covariance of z: where the quadratic functions are to be close.
struct Region {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

/// Margins and frequencies of all cuts, each a full quadratic in y = L⁻¹ (z − mean), L Lᵀ the region's covariance.
class QuadraticCuts {
 public:
  /// Fits by least squares to predict() at five normal draws of one and a half times the region's deviations for each
  /// unknown of a quadratic, by a generator of fixed seed. Throws InputError for a covariance that is not positive
  /// definite, and as predict(). Cost: these predictions; 225 with eight parameters.
  QuadraticCuts(const CutModel& model, const Region& region);

  /// The prediction at z, without slopes. Cost O(cuts parameters²).
  [[nodiscard]] PredictedCuts operator()(const Eigen::VectorXd& z) const;

 private:
  Region region_;
  Eigen::MatrixXd L_;
  Eigen::MatrixXd margins_, frequencies_;  ///< terms × cuts
};

}  // namespace thinwall::learning

#pragma once
// The judgement of a Gaussian process on what it has not seen.

#include <Eigen/Core>
#include <vector>

#include "regression/gaussian_process.hpp"

namespace thinwall::regression {

/// Predictions of places from the other folds.
struct CrossValidation {
  Eigen::MatrixXd mean;       ///< n × tasks; NaN where nothing was measured
  Eigen::MatrixXd deviation;  ///< with the noise
  Eigen::VectorXd R2;         ///< of each task, all folds together
  Eigen::VectorXd covered;    ///< share of each task within 1.96 deviations
};

/// Learns from all folds but one, for each. `fold` has a number from 0 on for each place. Throws InputError if there
/// are not as many as places or fewer than two different ones, and as fit(). Cost: a fit a fold.
[[nodiscard]] CrossValidation cross_validate(const TaskData& data, const std::vector<int>& fold,
                                             const SearchOptions& options = {});

/// 1 − Σ (y − ŷ)²/Σ (y − ȳ)² over what is there.
[[nodiscard]] double coefficient_of_determination(const Eigen::VectorXd& y, const Eigen::VectorXd& predicted);

}  // namespace thinwall::regression

#pragma once
// A Gaussian process of several tasks whose observations may be missing: one dense covariance of all of them.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/dense_factorisations.hpp"
#include "regression/hyper_parameters.hpp"
#include "regression/process_results.hpp"

namespace thinwall::regression {

/// The covariance of the observations, factorised.
struct DenseProcess {
  Kernel kernel = Kernel::squared_exponential;
  Eigen::MatrixXd inputs;
  HyperParameters parameters;
  Eigen::Index places = 0;
  std::vector<int> place, task;  ///< of each observation, place-major
  Eigen::VectorXd y;
  Eigen::LLT<Eigen::MatrixXd> K;
  Eigen::VectorXd alpha;  ///< K⁻¹ y
};

/// K = B ∘ κ + diag(noise² + jitter) over the observations that are there. None if it is not positive definite to
/// round-off. Cost O(N³) for N observations.
[[nodiscard]] std::optional<DenseProcess> dense_process(Kernel kernel, const TaskData& data,
                                                        const HyperParameters& parameters);

/// ln p = −½ yᵀα − ½ ln |K| − N/2 ln 2π and its gradient, ½ tr((ααᵀ − K⁻¹) ∂K) (Rasmussen & Williams 2006, Eq. 5.9).
/// Cost O(N³).
[[nodiscard]] Likelihood log_likelihood(const DenseProcess& process);

/// The function at the rows of `inputs`. Cost O(N² m tasks).
[[nodiscard]] Prediction predict(const DenseProcess& process, const Eigen::MatrixXd& inputs);

/// y_i − α_i/(K⁻¹)_ii with variance 1/(K⁻¹)_ii. Cost O(N³).
[[nodiscard]] LeaveOneOut leave_one_out(const DenseProcess& process);

}  // namespace thinwall::regression

#pragma once
// The numbers that fix a Gaussian process of several tasks, and the data that it learns from.

#include <Eigen/Core>

#include "regression/kernel.hpp"

namespace thinwall::regression {

/// Targets of several tasks at the same places.
struct TaskData {
  Eigen::MatrixXd inputs;   ///< n places × d dimensions, scaled to the order of 1
  Eigen::MatrixXd targets;  ///< n × tasks; NaN: not measured there

  /// The number of places.
  [[nodiscard]] Eigen::Index places() const { return inputs.rows(); }
  /// The number of tasks.
  [[nodiscard]] Eigen::Index tasks() const { return targets.cols(); }
  /// True if every task was measured at every place.
  [[nodiscard]] bool complete() const { return !targets.hasNaN(); }
};

/// The covariance of task s at x with task t at x' is B_st κ(x, x') plus, at the same observation, the noise of the
/// task: the intrinsic model of coregionalisation (Bonilla, Chai & Williams 2008; Lei 2022, Eq. 25-29), with B = L Lᵀ.
/// One task is the plain process, L its standard deviation.
struct HyperParameters {
  Eigen::VectorXd length;    ///< ℓ of each dimension, scaled inputs, > 0
  Eigen::MatrixXd L;         ///< tasks × tasks, lower triangular, diagonal > 0
  Eigen::VectorXd noise_sd;  ///< of each task, > 0

  /// The number of tasks.
  [[nodiscard]] Eigen::Index tasks() const { return L.rows(); }
  /// Covariance of the tasks, L Lᵀ.
  [[nodiscard]] Eigen::MatrixXd B() const { return L * L.transpose(); }
};

/// The parameters as one vector for an optimiser: ln ℓ; the rows of L, ln of its diagonal; ln of the noises.
[[nodiscard]] Eigen::VectorXd packed(const HyperParameters& parameters);

/// Its inverse, for that many dimensions and tasks.
[[nodiscard]] HyperParameters unpacked(const Eigen::VectorXd& theta, Eigen::Index dimensions, Eigen::Index tasks);

/// The gradient by packed() from ∂/∂ ln ℓ, ∂/∂L (what stands above its diagonal is not used) and ∂/∂ ln noise, held in
/// the places of the parameters.
[[nodiscard]] Eigen::VectorXd gradient_of(const HyperParameters& slope, const HyperParameters& at);

/// Number of entries of packed().
[[nodiscard]] constexpr Eigen::Index parameter_count(Eigen::Index dimensions, Eigen::Index tasks) {
  return dimensions + tasks * (tasks + 1) / 2 + tasks;
}

}  // namespace thinwall::regression

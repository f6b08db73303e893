#pragma once
// A Gaussian process of several tasks that were all measured at all places: K = B ⊗ κ + D ⊗ I in its eigenvectors.

#include <Eigen/Core>
#include <optional>

#include "regression/hyper_parameters.hpp"
#include "regression/process_results.hpp"

namespace thinwall::regression {

/// With D = diag(noise² + jitter) of the tasks, D^{−½} B D^{−½} = U Λ Uᵀ and κ = Q S Qᵀ,
///
///     K = (D^{½} U ⊗ Q) (Λ ⊗ S + I) (D^{½} U ⊗ Q)ᵀ,
///
/// which costs O(n³ + tasks³) in place of O((n tasks)³) and allows a noise for each task.
struct KroneckerProcess {
  Kernel kernel = Kernel::squared_exponential;
  TaskData data;
  HyperParameters parameters;
  Eigen::MatrixXd kappa;
  Eigen::MatrixXd Q;  ///< n × n
  Eigen::VectorXd S;
  Eigen::MatrixXd W;  ///< D^{−½} U, tasks × tasks
  Eigen::VectorXd Lambda;
  Eigen::VectorXd D;      ///< of each task
  Eigen::MatrixXd inner;  ///< 1/(S_j Λ_i + 1), n × tasks
  Eigen::MatrixXd alpha;  ///< K⁻¹ y, n × tasks
};

/// None if a number is not finite. `data` are complete. Throws InputError if they are not.
[[nodiscard]] std::optional<KroneckerProcess> kronecker_process(Kernel kernel, const TaskData& data,
                                                                const HyperParameters& parameters);

/// As of the dense process. Cost O(n³) for each dimension.
[[nodiscard]] Likelihood log_likelihood(const KroneckerProcess& process);

/// The function at the rows of `inputs`.
[[nodiscard]] Prediction predict(const KroneckerProcess& process, const Eigen::MatrixXd& inputs);

/// As of the dense process.
[[nodiscard]] LeaveOneOut leave_one_out(const KroneckerProcess& process);

}  // namespace thinwall::regression

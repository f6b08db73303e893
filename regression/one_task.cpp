#include "regression/one_task.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "core/dense_factorisations.hpp"
#include "regression/process_results.hpp"

namespace thinwall::regression {

OneTask one_task(Kernel kernel, const TaskData& data) {
  std::vector<Eigen::Index> seen;
  for (Eigen::Index i = 0; i < data.places(); ++i)
    if (!std::isnan(data.targets(i, 0))) seen.push_back(i);
  OneTask task{.kernel = kernel};
  task.y = data.targets.col(0)(seen);
  for (const auto& column : data.inputs.colwise()) {
    const Eigen::VectorXd x = column(seen);
    task.squares.emplace_back((x.replicate(1, x.size()) - x.transpose().replicate(x.size(), 1)).array().square());
  }
  return task;
}

double log_likelihood(const OneTask& task, const HyperParameters& parameters) {
  Eigen::ArrayXXd r2 = task.squares.front() / (parameters.length(0) * parameters.length(0));
  for (std::size_t d = 1; d < task.squares.size(); ++d) {
    const double length = parameters.length(static_cast<Eigen::Index>(d));
    r2 += task.squares[d] / (length * length);
  }
  Eigen::MatrixXd K = parameters.L(0, 0) * parameters.L(0, 0) * correlation(task.kernel, r2);
  K.diagonal().array() += parameters.noise_sd(0) * parameters.noise_sd(0) + jitter;
  const Eigen::LLT<Eigen::MatrixXd> factor(K);
  const auto diagonal = factor.matrixLLT().diagonal();
  if (factor.info() != Eigen::Success || !diagonal.allFinite()) return -std::numeric_limits<double>::infinity();
  return -0.5 * factor.matrixL().solve(task.y).squaredNorm() - diagonal.array().log().sum() -
         0.5 * static_cast<double>(task.y.size()) * std::log(2.0 * std::numbers::pi);
}

}  // namespace thinwall::regression

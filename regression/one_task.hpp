#pragma once
// The likelihood of one task without its gradient, for searches and averages that ask for it thousands of times.

#include <Eigen/Core>
#include <vector>

#include "regression/hyper_parameters.hpp"

namespace thinwall::regression {

/// The part of the data that the likelihood needs, whatever the hyper-parameters.
struct OneTask {
  Kernel kernel = Kernel::squared_exponential;
  std::vector<Eigen::ArrayXXd> squares{};  ///< of the differences along each column, of the places with a value
  Eigen::VectorXd y{};                     ///< the values that are there
};

/// The squared differences and values of data with one task. Cost O(n² d).
[[nodiscard]] OneTask one_task(Kernel kernel, const TaskData& data);

/// ln p as log_likelihood() of the dense process, with yᵀα = |L⁻¹y|² from the factor of K = L Lᵀ; −∞ where K is not
/// positive definite to round-off. Cost O(n³), a third of that with the gradient.
[[nodiscard]] double log_likelihood(const OneTask& task, const HyperParameters& parameters);

}  // namespace thinwall::regression

#include "regression/hyper_parameters.hpp"

#include <cmath>

namespace thinwall::regression {

Eigen::VectorXd packed(const HyperParameters& parameters) {
  const Eigen::Index d = parameters.length.size(), tasks = parameters.tasks();
  Eigen::VectorXd theta(parameter_count(d, tasks));
  theta.head(d) = parameters.length.array().log();
  Eigen::Index at = d;
  for (Eigen::Index i = 0; i < tasks; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) theta(at++) = i == j ? std::log(parameters.L(i, i)) : parameters.L(i, j);
  }
  theta.tail(tasks) = parameters.noise_sd.array().log();
  return theta;
}

HyperParameters unpacked(const Eigen::VectorXd& theta, Eigen::Index dimensions, Eigen::Index tasks) {
  HyperParameters parameters;
  parameters.length = theta.head(dimensions).array().exp();
  parameters.L = Eigen::MatrixXd::Zero(tasks, tasks);
  Eigen::Index at = dimensions;
  for (Eigen::Index i = 0; i < tasks; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j, ++at) parameters.L(i, j) = i == j ? std::exp(theta(at)) : theta(at);
  }
  parameters.noise_sd = theta.tail(tasks).array().exp();
  return parameters;
}

Eigen::VectorXd gradient_of(const HyperParameters& slope, const HyperParameters& at) {
  const Eigen::Index d = at.length.size(), tasks = at.tasks();
  Eigen::VectorXd gradient(parameter_count(d, tasks));
  gradient.head(d) = slope.length;
  Eigen::Index k = d;
  for (Eigen::Index i = 0; i < tasks; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) gradient(k++) = slope.L(i, j) * (i == j ? at.L(i, i) : 1.0);
  }
  gradient.tail(tasks) = slope.noise_sd;
  return gradient;
}

}  // namespace thinwall::regression

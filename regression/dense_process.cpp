#include "regression/dense_process.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace thinwall::regression {

namespace {

/// The covariance between observations and the function of all tasks at other places, κ as n × m.
Eigen::MatrixXd cross_covariance(const DenseProcess& process, const Eigen::MatrixXd& correlation,
                                 const Eigen::MatrixXd& B) {
  const Eigen::Index tasks = B.rows();
  Eigen::MatrixXd k(process.y.size(), correlation.cols() * tasks);
  for (Eigen::Index a = 0; a < k.rows(); ++a) {
    const auto i = static_cast<std::size_t>(a);
    for (Eigen::Index m = 0; m < correlation.cols(); ++m)
      k.row(a).segment(m * tasks, tasks) = correlation(process.place[i], m) * B.row(process.task[i]);
  }
  return k;
}

}  // namespace

std::optional<DenseProcess> dense_process(Kernel kernel, const TaskData& data, const HyperParameters& parameters) {
  DenseProcess process{kernel, data.inputs, parameters, data.places(), {}, {}, {}, {}, {}};
  std::vector<double> y;
  for (Eigen::Index i = 0; i < data.places(); ++i) {
    for (Eigen::Index t = 0; t < data.tasks(); ++t) {
      if (std::isnan(data.targets(i, t))) continue;
      process.place.push_back(static_cast<int>(i));
      process.task.push_back(static_cast<int>(t));
      y.push_back(data.targets(i, t));
    }
  }
  process.y = Eigen::Map<const Eigen::VectorXd>(y.data(), static_cast<Eigen::Index>(y.size()));
  const Eigen::MatrixXd kappa = correlation(kernel, data.inputs, data.inputs, parameters.length);
  const Eigen::MatrixXd B = parameters.B();
  const Eigen::Index N = process.y.size();
  Eigen::MatrixXd K(N, N);
  for (Eigen::Index b = 0; b < N; ++b) {
    const auto j = static_cast<std::size_t>(b);
    for (Eigen::Index a = b; a < N; ++a) {
      const auto i = static_cast<std::size_t>(a);
      K(a, b) = B(process.task[i], process.task[j]) * kappa(process.place[i], process.place[j]);
    }
    const double noise = parameters.noise_sd(process.task[j]);
    K(b, b) += noise * noise + jitter;
  }
  process.K.compute(K);
  // The triangle above the diagonal is not set; a number that is not finite below it has reached the diagonal.
  if (process.K.info() != Eigen::Success || !process.K.matrixLLT().diagonal().allFinite()) return std::nullopt;
  process.alpha = process.K.solve(process.y);
  return process;
}

Likelihood log_likelihood(const DenseProcess& process) {
  const Eigen::Index N = process.y.size(), d = process.inputs.cols(), tasks = process.parameters.tasks();
  Likelihood result;
  result.value = -0.5 * process.y.dot(process.alpha) - process.K.matrixLLT().diagonal().array().log().sum() -
                 0.5 * static_cast<double>(N) * std::log(2.0 * std::numbers::pi);
  const Eigen::MatrixXd inverse = process.K.solve(Eigen::MatrixXd::Identity(N, N));
  const Eigen::MatrixXd kappa = correlation(process.kernel, process.inputs, process.inputs, process.parameters.length);
  const Eigen::MatrixXd B = process.parameters.B();
  // ½ (ααᵀ − K⁻¹) of each pair, summed over the observations of a pair of tasks with κ, and of a pair of places with B.
  Eigen::MatrixXd of_tasks = Eigen::MatrixXd::Zero(tasks, tasks);
  Eigen::MatrixXd of_places = Eigen::MatrixXd::Zero(process.places, process.places);
  Eigen::VectorXd of_noise = Eigen::VectorXd::Zero(tasks);
  for (Eigen::Index b = 0; b < N; ++b) {
    const int s = process.task[static_cast<std::size_t>(b)], j = process.place[static_cast<std::size_t>(b)];
    for (Eigen::Index a = 0; a < N; ++a) {
      const int t = process.task[static_cast<std::size_t>(a)], i = process.place[static_cast<std::size_t>(a)];
      const double g = 0.5 * (process.alpha(a) * process.alpha(b) - inverse(a, b));
      of_tasks(t, s) += g * kappa(i, j);
      of_places(i, j) += g * B(t, s);
      if (a == b) of_noise(s) += g;
    }
  }
  HyperParameters slope = process.parameters;  // of the same shape
  for (Eigen::Index k = 0; k < d; ++k) {
    slope.length(k) =
        of_places.cwiseProduct(correlation_change(process.kernel, process.inputs, process.parameters.length, k)).sum();
  }
  slope.L = 2.0 * of_tasks * process.parameters.L;
  slope.noise_sd = 2.0 * process.parameters.noise_sd.array().square() * of_noise.array();
  result.gradient = gradient_of(slope, process.parameters);
  return result;
}

Prediction predict(const DenseProcess& process, const Eigen::MatrixXd& inputs) {
  const Eigen::MatrixXd B = process.parameters.B();
  const Eigen::Index m = inputs.rows(), tasks = B.rows();
  const Eigen::MatrixXd k =
      cross_covariance(process, correlation(process.kernel, process.inputs, inputs, process.parameters.length), B);
  const Eigen::MatrixXd between = correlation(process.kernel, inputs, inputs, process.parameters.length);
  Prediction result;
  result.mean = (k.transpose() * process.alpha).reshaped(tasks, m).transpose();
  result.covariance.resize(m * tasks, m * tasks);
  for (Eigen::Index i = 0; i < m; ++i) {
    for (Eigen::Index j = 0; j < m; ++j)
      result.covariance.block(i * tasks, j * tasks, tasks, tasks) = between(i, j) * B;
  }
  const Eigen::MatrixXd known = process.K.matrixL().solve(k);
  result.covariance -= known.transpose() * known;
  return result;
}

LeaveOneOut leave_one_out(const DenseProcess& process) {
  const Eigen::Index N = process.y.size();
  const Eigen::VectorXd of_inverse = process.K.solve(Eigen::MatrixXd::Identity(N, N)).diagonal();
  LeaveOneOut result;
  result.mean.setConstant(process.places, process.parameters.tasks(), std::numeric_limits<double>::quiet_NaN());
  result.variance = result.mean;
  for (Eigen::Index a = 0; a < N; ++a) {
    const int i = process.place[static_cast<std::size_t>(a)], t = process.task[static_cast<std::size_t>(a)];
    result.mean(i, t) = process.y(a) - process.alpha(a) / of_inverse(a);
    result.variance(i, t) = 1.0 / of_inverse(a);
  }
  return result;
}

}  // namespace thinwall::regression

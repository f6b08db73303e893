#include "regression/averaged_process.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "regression/gaussian_process.hpp"
#include "regression/one_task.hpp"

namespace thinwall::regression {

namespace {

void require_one_task(const TaskData& data, const AveragingOptions& options) {
  const auto refuse = [](const std::string& what) { throw core::InputError("averaged process: " + what); };
  if (data.tasks() != 1) refuse(std::to_string(data.tasks()) + " tasks, must be one; give each a process of its own");
  if (data.inputs.rows() != data.targets.rows())
    refuse(std::to_string(data.inputs.rows()) + " places and " + std::to_string(data.targets.rows()) +
           " targets, must be as many");
  if (!data.inputs.allFinite()) refuse("a place is not finite; correct it");
  const Eigen::Index seen = data.places() - data.targets.array().isNaN().count();
  if (seen < 2) refuse(std::to_string(seen) + " values, must be at least 2; measure at more places");
  if (options.samples < 1) refuse(std::to_string(options.samples) + " samples, must be at least 1");
}

/// The logarithm of the posterior, up to a constant.
struct Posterior {
  OneTask task;
  Eigen::VectorXd mean{}, deviation{};  ///< of the prior of each logarithm

  double operator()(const Eigen::VectorXd& theta) const {
    return log_likelihood(task, unpacked(theta, std::ssize(task.squares), 1)) -
           0.5 * (theta - mean).cwiseQuotient(deviation).squaredNorm();
  }
};

Posterior posterior_of(const TaskData& data, const AveragingOptions& options) {
  const HyperPrior& prior = options.prior;
  const Eigen::Index d = data.inputs.cols();
  Posterior result{.task = one_task(options.kernel, data)};
  result.mean = Eigen::VectorXd::Constant(d + 2, prior.ln_length);
  result.deviation = Eigen::VectorXd::Constant(d + 2, prior.sd_ln_length);
  result.mean.tail(2) << prior.ln_signal, prior.ln_noise;
  result.deviation.tail(2) << prior.sd_ln_signal, prior.sd_ln_noise;
  return result;
}

/// A number from 0 to 1, written out because distributions of the standard library draw differently elsewhere.
double uniform_draw(std::mt19937& random) {
  return (static_cast<double>(random()) + 0.5) / (static_cast<double>(std::mt19937::max()) + 1.0);
}

/// Moves one parameter to a uniform draw from the slice above a random share of its density: an interval around it is
/// widened until its ends lie below, and shrunk to the draws that do.
void slice(const Posterior& posterior, Eigen::VectorXd& theta, Eigen::Index k, double& value, std::mt19937& random) {
  const double level = value + std::log(uniform_draw(random));
  const double at = theta(k), width = posterior.deviation(k);
  double low = at - width * uniform_draw(random), high = low + width;
  const auto value_at = [&](double place) {
    theta(k) = place;
    return posterior(theta);
  };
  while (value_at(low) > level) low -= width;
  while (value_at(high) > level) high += width;
  while (true) {
    const double place = low + (high - low) * uniform_draw(random);
    const double there = value_at(place);
    if (there >= level) {
      value = there;
      return;
    }
    (place < at ? low : high) = place;
    if (!(high - low > 1e-12)) break;
  }
  theta(k) = at;
}

}  // namespace

AveragedProcess::AveragedProcess(const TaskData& data, const AveragingOptions& options) {
  require_one_task(data, options);
  constexpr int first_sweeps = 12, sweeps_between = 2;
  const Standardised scaled = standardised(data);
  mean_ = scaled.mean(0);
  deviation_ = scaled.deviation(0);
  const Posterior posterior = posterior_of(scaled.data, options);
  Eigen::VectorXd theta = posterior.mean;
  double value = posterior(theta);
  if (!std::isfinite(value))
    throw core::NumericalError("averaged process: the covariance is not positive definite; two places may be the same");
  const double places = static_cast<double>(data.places());
  const int samples = std::min(options.samples, std::max(12, static_cast<int>(1500.0 / places)));
  std::mt19937 random(options.seed);
  const int most_sweeps = first_sweeps + 10 * sweeps_between * samples;
  for (int sweep = 0; static_cast<int>(draws_.size()) < samples; ++sweep) {
    if (sweep == most_sweeps)
      throw core::NumericalError(
          "averaged process: the covariances that were drawn are not positive definite; two "
          "places may be nearly the same");
    for (Eigen::Index k = 0; k < theta.size(); ++k) slice(posterior, theta, k, value, random);
    if (sweep < first_sweeps || (sweep - first_sweeps) % sweeps_between != 0) continue;
    auto drawn = dense_process(options.kernel, scaled.data, unpacked(theta, data.inputs.cols(), 1));
    if (drawn) draws_.push_back(std::move(*drawn));
  }
}

AveragedPrediction AveragedProcess::predict(const Eigen::MatrixXd& inputs) const {
  const Eigen::Index m = inputs.rows();
  AveragedPrediction result{Eigen::VectorXd::Zero(m), Eigen::MatrixXd::Zero(m, m)};
  const double share = 1.0 / static_cast<double>(draws_.size());
  for (const DenseProcess& process : draws_) {
    const Prediction at = regression::predict(process, inputs);
    result.mean += share * at.mean.col(0);
    result.covariance += share * (at.covariance + at.mean.col(0) * at.mean.col(0).transpose());
    result.noise_variance += share * process.parameters.noise_sd(0) * process.parameters.noise_sd(0);
  }
  result.covariance -= result.mean * result.mean.transpose();
  result.mean = (deviation_ * result.mean).array() + mean_;
  result.covariance *= deviation_ * deviation_;
  result.noise_variance *= deviation_ * deviation_;
  return result;
}

Eigen::VectorXd AveragedProcess::standardised_residuals() const {
  const Eigen::VectorXd& y = draws_.front().y;
  const double share = 1.0 / static_cast<double>(draws_.size());
  Eigen::ArrayXd mean = Eigen::ArrayXd::Zero(y.size()), square = mean;
  for (const DenseProcess& process : draws_) {
    const LeaveOneOut without = leave_one_out(process);
    const std::vector<int>& seen = process.place;
    const Eigen::ArrayXd there = without.mean.col(0)(seen).array();
    mean += share * there;
    square += share * (there.square() + without.variance.col(0)(seen).array());
  }
  return (y.array() - mean) / (square - mean.square()).sqrt();
}

}  // namespace thinwall::regression

#include "regression/gaussian_process.hpp"

#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <utility>

#include "core/error.hpp"

namespace thinwall::regression {

namespace {

Likelihood likelihood_at(Kernel kernel, const TaskData& data, const HyperParameters& parameters) {
  if (data.complete() && data.tasks() > 1) {
    const auto process = kronecker_process(kernel, data, parameters);
    return process ? log_likelihood(*process) : Likelihood{};
  }
  const auto process = dense_process(kernel, data, parameters);
  return process ? log_likelihood(*process) : Likelihood{};
}

/// The search from one start, and the best place it has seen.
struct Search {
  const TaskData& data;
  Kernel kernel;
  Eigen::VectorXd best;
  double best_value = -std::numeric_limits<double>::infinity();

  /// −ln p for the optimiser; a place without a likelihood is a wall.
  double operator()(const Eigen::VectorXd& theta, double* gradient) {
    constexpr double wall = 1e10;
    const Likelihood at = likelihood_at(kernel, data, unpacked(theta, data.inputs.cols(), data.tasks()));
    if (!std::isfinite(at.value) || !at.gradient.allFinite()) {
      if (gradient != nullptr) std::fill_n(gradient, theta.size(), 0.0);
      return wall;
    }
    if (at.value > best_value) {
      best_value = at.value;
      best = theta;
    }
    if (gradient != nullptr) Eigen::Map<Eigen::VectorXd>(gradient, theta.size()) = -at.gradient;
    return -at.value;
  }
};

double objective(unsigned n, const double* x, double* gradient, void* search) {
  return (*static_cast<Search*>(search))(Eigen::Map<const Eigen::VectorXd>(x, n), gradient);
}

struct Box {
  Eigen::VectorXd low, high;
};

Box box_of(const Bounds& bounds, Eigen::Index dimensions, Eigen::Index tasks) {
  const auto with = [&](double length, double sd, double beside, double noise) {
    HyperParameters p;
    p.length.setConstant(dimensions, length);
    p.L = Eigen::MatrixXd::Constant(tasks, tasks, beside);
    p.L.diagonal().setConstant(sd);
    p.noise_sd.setConstant(tasks, noise);
    return packed(p);
  };
  return {with(bounds.least_length, bounds.least_sd, -bounds.largest_sd, bounds.least_noise),
          with(bounds.largest_length, bounds.largest_sd, bounds.largest_sd, bounds.largest_noise)};
}

/// Runs an algorithm from a place; the search keeps the best that it saw, however the algorithm ends.
void run(nlopt_algorithm algorithm, const Box& box, Eigen::VectorXd from, Search& search) {
  constexpr int most_likelihoods = 400;
  const std::unique_ptr<nlopt_opt_s, decltype(&nlopt_destroy)> optimiser(
      nlopt_create(algorithm, static_cast<unsigned>(from.size())), &nlopt_destroy);
  nlopt_set_min_objective(optimiser.get(), objective, &search);
  nlopt_set_lower_bounds(optimiser.get(), box.low.data());
  nlopt_set_upper_bounds(optimiser.get(), box.high.data());
  nlopt_set_ftol_rel(optimiser.get(), 1e-10);
  nlopt_set_maxeval(optimiser.get(), most_likelihoods);
  double value = 0.0;
  (void)nlopt_optimize(optimiser.get(), from.data(), &value);
}

/// A function of length 1 that is mostly not noise.
Eigen::VectorXd first_start(Eigen::Index dimensions, Eigen::Index tasks, const Box& box) {
  HyperParameters p;
  p.length.setOnes(dimensions);
  p.L = Eigen::MatrixXd::Identity(tasks, tasks);
  p.noise_sd.setConstant(tasks, 0.3);
  return packed(p).cwiseMax(box.low).cwiseMin(box.high);
}

Eigen::VectorXd drawn_start(Eigen::Index dimensions, Eigen::Index tasks, const Box& box, std::mt19937& random) {
  // Written out, because distributions of the standard library draw differently elsewhere.
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
  };
  HyperParameters p{Eigen::VectorXd(dimensions), Eigen::MatrixXd::Zero(tasks, tasks), Eigen::VectorXd(tasks)};
  for (double& length : p.length) length = std::exp(between(std::log(0.12), std::log(5.0)));
  for (Eigen::Index i = 0; i < tasks; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) p.L(i, j) = between(-0.7, 0.7);
    p.L(i, i) = between(0.3, 2.0);
  }
  for (double& noise : p.noise_sd) noise = std::exp(between(std::log(0.03), 0.0));
  return packed(p).cwiseMax(box.low).cwiseMin(box.high);
}

/// The likeliest of some drawn starts: from bad ones the search often ends where all is noise.
Eigen::VectorXd likeliest_start(const TaskData& data, Kernel kernel, const Box& box, std::mt19937& random) {
  constexpr int draws = 8;
  const Eigen::Index dimensions = data.inputs.cols(), tasks = data.tasks();
  Eigen::VectorXd best;
  double largest = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < draws; ++i) {
    const Eigen::VectorXd drawn = drawn_start(dimensions, tasks, box, random);
    const double value = likelihood_at(kernel, data, unpacked(drawn, dimensions, tasks)).value;
    if (best.size() > 0 && !(value > largest)) continue;
    best = drawn;
    largest = value;
  }
  return best;
}

void require_usable(const TaskData& data, const SearchOptions& options) {
  if (data.inputs.rows() != data.targets.rows() || data.inputs.size() == 0 || data.targets.size() == 0)
    throw core::InputError("regression: " + std::to_string(data.inputs.rows()) + " places and " +
                           std::to_string(data.targets.rows()) +
                           " rows of targets, must be as many and more than none");
  if (!data.inputs.allFinite()) throw core::InputError("regression: a place is not finite; correct it");
  if (options.starts < 1)
    throw core::InputError("regression: " + std::to_string(options.starts) + " starts, must be at least 1");
  for (Eigen::Index t = 0; t < data.tasks(); ++t) {
    const auto seen = data.targets.col(t).array().isNaN().size() - data.targets.col(t).array().isNaN().count();
    if (seen < 2) {
      throw core::InputError("regression: " + std::to_string(seen) + " values of task " + std::to_string(t + 1) +
                             ", must be at least 2; measure at more places");
    }
  }
}

}  // namespace

Fit fit(const TaskData& data, const SearchOptions& options) {
  require_usable(data, options);
  const Eigen::Index dimensions = data.inputs.cols(), tasks = data.tasks();
  const Box box = box_of(options.bounds, dimensions, tasks);
  std::mt19937 random(options.seed);
  Fit result;
  Eigen::VectorXd best;
  result.log_likelihood = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < options.starts; ++i) {
    Search search{data, options.kernel, {}};
    const Eigen::VectorXd from =
        i == 0 ? first_start(dimensions, tasks, box) : likeliest_start(data, options.kernel, box, random);
    run(NLOPT_LD_LBFGS, box, from, search);
    if (search.best_value < result.log_likelihood - 1e-6 || i == 0)
      run(NLOPT_LD_SLSQP, box, search.best.size() > 0 ? search.best : from, search);
    result.of_starts.push_back(search.best_value);
    if (search.best_value <= result.log_likelihood) continue;
    result.log_likelihood = search.best_value;
    best = search.best;
  }
  if (best.size() == 0)
    throw core::NumericalError(
        "regression: no start has a likelihood; two places may be the same, or targets not finite");
  std::sort(result.of_starts.begin(), result.of_starts.end(), std::greater<>());
  result.parameters = unpacked(best, dimensions, tasks);
  return result;
}

Standardised standardised(const TaskData& data) {
  Standardised result{data, Eigen::VectorXd::Zero(data.tasks()), Eigen::VectorXd::Ones(data.tasks())};
  for (Eigen::Index t = 0; t < data.tasks(); ++t) {
    double count = 0.0, sum = 0.0, square = 0.0;
    for (const double v : data.targets.col(t)) {
      if (std::isnan(v)) continue;
      count += 1.0;
      sum += v;
    }
    const double mean = sum / count;
    for (const double v : data.targets.col(t)) {
      if (!std::isnan(v)) square += (v - mean) * (v - mean);
    }
    result.mean(t) = mean;
    if (square > 0.0) result.deviation(t) = std::sqrt(square / count);
    result.data.targets.col(t).array() = (data.targets.col(t).array() - mean) / result.deviation(t);
  }
  return result;
}

GaussianProcess::GaussianProcess(const TaskData& data, const SearchOptions& options)
    : scaled_(standardised(data)), fit_(fit(scaled_.data, options)) {
  learn(options.kernel);
}

GaussianProcess::GaussianProcess(const TaskData& data, const HyperParameters& parameters, Kernel kernel)
    : scaled_(standardised(data)) {
  fit_.parameters = parameters;
  fit_.log_likelihood = likelihood_at(kernel, scaled_.data, parameters).value;
  fit_.of_starts = {fit_.log_likelihood};
  learn(kernel);
}

void GaussianProcess::learn(Kernel kernel) {
  const auto take = [this](auto process) {
    if (!process)
      throw core::NumericalError("regression: the covariance is not positive definite; two places may be the same");
    process_ = std::move(*process);
  };
  if (scaled_.data.complete() && scaled_.data.tasks() > 1) {
    take(kronecker_process(kernel, scaled_.data, fit_.parameters));
  } else {
    take(dense_process(kernel, scaled_.data, fit_.parameters));
  }
}

Prediction GaussianProcess::predict(const Eigen::MatrixXd& inputs) const {
  Prediction at = std::visit([&](const auto& process) { return regression::predict(process, inputs); }, process_);
  at.mean = (at.mean * scaled_.deviation.asDiagonal()).rowwise() + scaled_.mean.transpose();
  const Eigen::VectorXd deviations = scaled_.deviation.replicate(inputs.rows(), 1);
  at.covariance = deviations.asDiagonal() * at.covariance * deviations.asDiagonal();
  return at;
}

LeaveOneOut GaussianProcess::leave_one_out() const {
  LeaveOneOut left = std::visit([](const auto& process) { return regression::leave_one_out(process); }, process_);
  left.mean = (left.mean * scaled_.deviation.asDiagonal()).rowwise() + scaled_.mean.transpose();
  left.variance = left.variance * scaled_.deviation.cwiseAbs2().asDiagonal();
  return left;
}

Eigen::VectorXd GaussianProcess::noise_sd() const {
  return fit_.parameters.noise_sd.cwiseProduct(scaled_.deviation);
}

}  // namespace thinwall::regression

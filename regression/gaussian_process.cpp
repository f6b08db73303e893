#include "regression/gaussian_process.hpp"

#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "regression/one_task.hpp"

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

/// ln p alone, −∞ where there is none.
double value_at(Kernel kernel, const TaskData& data, const HyperParameters& parameters) {
  if (data.tasks() == 1) return log_likelihood(one_task(kernel, data), parameters);
  return likelihood_at(kernel, data, parameters).value;
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
  const int most_likelihoods = std::max(400, static_cast<int>(5 * from.size()));
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

/// L with L Lᵀ near the correlation of the targets; values that are missing count as their mean.
Eigen::MatrixXd factor_of_targets(const TaskData& data) {
  constexpr double own = 0.05;  // share of a task that is its own, without which the matrix may be singular
  const Eigen::MatrixXd Y = data.targets.array().isNaN().select(0.0, data.targets);
  const Eigen::MatrixXd C = (1.0 - own) / static_cast<double>(data.places()) * (Y.transpose() * Y);
  return Eigen::LLT<Eigen::MatrixXd>(Eigen::MatrixXd(C + own * Eigen::MatrixXd::Identity(C.rows(), C.cols())))
      .matrixL();
}

/// A function of length 1 that is mostly not noise, with tasks as alike as their targets.
HyperParameters first_start(const TaskData& data) {
  return {Eigen::VectorXd::Ones(data.inputs.cols()), factor_of_targets(data),
          Eigen::VectorXd::Constant(data.tasks(), 0.3)};
}

HyperParameters drawn_start(const TaskData& data, std::mt19937& random) {
  // Written out, because distributions of the standard library draw differently elsewhere.
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
  };
  HyperParameters p = first_start(data);
  for (double& length : p.length) length = std::exp(between(std::log(0.12), std::log(5.0)));
  for (Eigen::Index i = 0; i < data.tasks(); ++i) p.L.row(i) *= between(0.3, 2.0);
  for (double& noise : p.noise_sd) noise = std::exp(between(std::log(0.03), 0.0));
  return p;
}

/// The first start, and of each other the likeliest of some draws: from bad ones the search often ends where all is
/// noise.
std::vector<Eigen::VectorXd> starts_of(const TaskData& data, const SearchOptions& options, const Box& box) {
  constexpr std::size_t draws = 8;
  const auto within = [&](const HyperParameters& p) {
    return Eigen::VectorXd(packed(p).cwiseMax(box.low).cwiseMin(box.high));
  };
  const auto count = static_cast<std::size_t>(search_starts(options, data.inputs.cols(), data.tasks()));
  std::vector<Eigen::VectorXd> drawn;
  std::mt19937 random(options.seed);
  for (std::size_t i = 0; i < draws * (count - 1); ++i) drawn.push_back(within(drawn_start(data, random)));
  std::vector<double> value(drawn.size());
  core::parallel_for(drawn.size(), [&](std::size_t i) {
    value[i] = value_at(options.kernel, data, unpacked(drawn[i], data.inputs.cols(), data.tasks()));
  });
  std::vector<Eigen::VectorXd> starts{within(options.first ? *options.first : first_start(data))};
  for (auto first = value.begin(); first != value.end(); first += draws)
    starts.push_back(drawn[static_cast<std::size_t>(std::max_element(first, first + draws) - value.begin())]);
  return starts;
}

/// The ends of the searches from all starts. Those that ended worse than the best, and one at least, search on by the
/// second algorithm, of which a step costs the cube of the number of parameters.
std::vector<Search> searches_from(const std::vector<Eigen::VectorXd>& starts, const TaskData& data,
                                  const SearchOptions& options, const Box& box) {
  constexpr Eigen::Index most_for_slsqp = 60;
  std::vector<Search> searches(starts.size(), Search{data, options.kernel, {}});
  core::parallel_for(starts.size(), [&](std::size_t i) { run(NLOPT_LD_LBFGS, box, starts[i], searches[i]); });
  const auto best = std::ranges::max_element(searches, {}, &Search::best_value);
  const double largest = best->best_value;
  const auto one = static_cast<std::size_t>(best - searches.begin());
  core::parallel_for(starts.size(), [&](std::size_t i) {
    if (i != one && searches[i].best_value >= largest - 1e-6) return;
    const Eigen::VectorXd from = searches[i].best.size() > 0 ? searches[i].best : starts[i];
    run(from.size() > most_for_slsqp ? NLOPT_LD_LBFGS : NLOPT_LD_SLSQP, box, from, searches[i]);
  });
  return searches;
}

void require_usable(const TaskData& data, const SearchOptions& options) {
  if (data.inputs.rows() != data.targets.rows() || data.inputs.size() == 0 || data.targets.size() == 0)
    throw core::InputError("regression: " + std::to_string(data.inputs.rows()) + " places and " +
                           std::to_string(data.targets.rows()) +
                           " rows of targets, must be as many and more than none");
  if (!data.inputs.allFinite()) throw core::InputError("regression: a place is not finite; correct it");
  if (options.starts < 1)
    throw core::InputError("regression: " + std::to_string(options.starts) + " starts, must be at least 1");
  if (options.first && (options.first->length.size() != data.inputs.cols() || options.first->tasks() != data.tasks()))
    throw core::InputError("regression: a first start of " + std::to_string(options.first->length.size()) +
                           " lengths and " + std::to_string(options.first->tasks()) + " tasks, must be of " +
                           std::to_string(data.inputs.cols()) + " and " + std::to_string(data.tasks()) +
                           ", as the data are");
  for (Eigen::Index t = 0; t < data.tasks(); ++t) {
    const auto seen = data.targets.col(t).array().isNaN().size() - data.targets.col(t).array().isNaN().count();
    if (seen < 2) {
      throw core::InputError("regression: " + std::to_string(seen) + " values of task " + std::to_string(t + 1) +
                             ", must be at least 2; measure at more places");
    }
  }
}

}  // namespace

int search_starts(const SearchOptions& options, Eigen::Index dimensions, Eigen::Index tasks) {
  constexpr Eigen::Index many = 100;
  constexpr int of_many = 4;
  return parameter_count(dimensions, tasks) > many ? std::min(options.starts, of_many) : options.starts;
}

Fit fit(const TaskData& data, const SearchOptions& options) {
  require_usable(data, options);
  const Eigen::Index dimensions = data.inputs.cols(), tasks = data.tasks();
  const Box box = box_of(options.bounds, dimensions, tasks);
  const std::vector<Search> searches = searches_from(starts_of(data, options, box), data, options, box);
  const auto best = std::ranges::max_element(searches, {}, &Search::best_value);
  if (best->best.size() == 0)
    throw core::NumericalError(
        "regression: no start has a likelihood; two places may be the same, or targets not finite");
  Fit result{unpacked(best->best, dimensions, tasks), best->best_value, {}};
  for (const Search& search : searches) result.of_starts.push_back(search.best_value);
  std::ranges::sort(result.of_starts, std::greater<>());
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

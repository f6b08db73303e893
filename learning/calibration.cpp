#include "learning/calibration.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <utility>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "core/median.hpp"
#include "core/parallel.hpp"
#include "learning/interpolated_cuts.hpp"

namespace thinwall::learning {

namespace {

using Eigen::Index;

constexpr double contradicted = 0.05;

void require_usable(const CutModel& model) {
  if (model.cuts.empty()) throw core::InputError("calibration: there are no cuts; give [[observed]]");
  if (model.parameters.empty())
    throw core::InputError("calibration: nothing is uncertain; give [lobes.uncertainty], which is known beforehand");
}

Eigen::VectorXd without_noise(const Eigen::VectorXd& x) {
  return x.head(x.size() - 1);
}

/// The draws of all chains.
std::vector<Eigen::VectorXd> all_draws(const Chains& chains) {
  std::vector<Eigen::VectorXd> all;
  for (const Eigen::MatrixXd& chain : chains.draws)
    for (Index i = 0; i < chain.cols(); ++i) all.emplace_back(chain.col(i));
  return all;
}

/// z of every draw.
std::vector<Eigen::VectorXd> places_of(const std::vector<Eigen::VectorXd>& draws) {
  std::vector<Eigen::VectorXd> places;
  places.reserve(draws.size());
  for (const Eigen::VectorXd& x : draws) places.push_back(without_noise(x));
  return places;
}

/// Three z for each coefficient of a quadratic about every region, normally distributed, a third wider than it.
std::vector<Eigen::VectorXd> places_about(const std::vector<Region>& regions) {
  constexpr double wider = 1.3;
  std::mt19937 random(1);
  std::vector<Eigen::VectorXd> places;
  for (const Region& region : regions) {
    const Index unknowns = region.mean.size();
    const Eigen::MatrixXd L = Eigen::LLT<Eigen::MatrixXd>(region.covariance).matrixL();
    for (Index i = 0; i < 3 * quadratic_terms(unknowns - 1); ++i)
      places.push_back(without_noise(region.mean + wider * L * milling::standard_normal(unknowns, random)));
  }
  return places;
}

std::vector<LearnedParameter> learned_parameters(const Calibration& c) {
  const ChainDiagnostics diagnostics = diagnose(c.chains.draws);
  std::vector<LearnedParameter> list;
  for (std::size_t p = 0; p < c.model.parameters.size(); ++p) {
    const auto k = static_cast<Index>(p);
    double mean = 0.0, square = 0.0;
    for (const Eigen::VectorXd& x : c.draws) mean += x(k) / static_cast<double>(c.draws.size());
    for (const Eigen::VectorXd& x : c.draws) square += (x(k) - mean) * (x(k) - mean);
    const milling::UncertainParameter& parameter = c.model.parameters[p];
    list.push_back({parameter, milling::value_of(c.model.nominal, parameter, 0.0),
                    milling::value_of(c.model.nominal, parameter, mean), mean,
                    std::sqrt(square / static_cast<double>(c.draws.size() - 1)), c.likeliest.x(k),
                    std::sqrt(c.likeliest.covariance(k, k)), diagnostics.r_hat(k), diagnostics.effective_size(k)});
  }
  return list;
}

/// Probabilities of chatter by interpolated predictions, the mean over the draws.
std::vector<LearnedCut> learned_cuts(const Calibration& c, const InterpolatedCuts& prediction) {
  Eigen::VectorXd chatters = Eigen::VectorXd::Zero(std::ssize(c.model.cuts));
  for (const Eigen::VectorXd& x : c.draws) {
    const PredictedCuts predicted = prediction(without_noise(x));
    const double noise = noise_of(c.model, x);
    for (Index i = 0; i < chatters.size(); ++i)
      chatters(i) += chatter_probability(predicted.margin(i), noise) / static_cast<double>(c.draws.size());
  }
  std::vector<LearnedCut> list;
  for (std::size_t i = 0; i < c.model.cuts.size(); ++i) {
    const double p = chatters(static_cast<Index>(i));
    const milling::CutOutcome outcome = c.model.cuts[i].outcome;
    const bool contradicts = (outcome == milling::CutOutcome::stable && 1.0 - p < contradicted) ||
                             (outcome == milling::CutOutcome::chatter && p < contradicted);
    list.push_back({c.model.cuts[i], p, contradicts});
  }
  return list;
}

/// True if two maxima lie within one deviation of each other.
bool are_near(const Likeliest& a, const Likeliest& b) {
  const Eigen::VectorXd off = a.x - b.x;
  return off.dot(Eigen::LLT<Eigen::MatrixXd>(a.covariance).solve(off)) < 1.0;
}

/// x = 0, and the likeliest two of some draws of what is known beforehand.
std::vector<Eigen::VectorXd> good_starts(const CutModel& model) {
  constexpr std::size_t drawn = 48, taken = 2;
  const auto unknowns = std::ssize(model.parameters) + 1;
  std::mt19937 random(1);
  std::vector<std::pair<double, Eigen::VectorXd>> list(drawn);
  for (auto& entry : list) entry.second = milling::standard_normal(unknowns, random);
  core::parallel_for(drawn, [&](std::size_t i) {
    list[i].first = log_posterior(model, predict(model, without_noise(list[i].second), false), list[i].second);
  });
  std::ranges::stable_sort(list, std::ranges::greater{}, &std::pair<double, Eigen::VectorXd>::first);
  std::vector<Eigen::VectorXd> starts{Eigen::VectorXd::Zero(unknowns)};
  for (std::size_t i = 0; i < taken; ++i) starts.push_back(list[i].second);
  return starts;
}

}  // namespace

std::vector<Likeliest> maxima(const CutModel& model) {
  require_usable(model);
  const std::vector<Eigen::VectorXd> starts = good_starts(model);
  std::vector<Likeliest> found(starts.size());
  core::parallel_for(starts.size(), [&](std::size_t i) { found[i] = likeliest_from(model, starts[i]); });
  std::ranges::stable_sort(found, std::ranges::greater{}, &Likeliest::log_posterior);
  std::vector<Likeliest> apart;
  for (Likeliest& one : found) {
    const bool is_new = std::ranges::none_of(apart, [&](const Likeliest& other) { return are_near(one, other); });
    if (is_new) apart.push_back(std::move(one));
  }
  return apart;
}

Likeliest likeliest(const CutModel& model) {
  return maxima(model).front();
}

Likeliest likeliest_from(const CutModel& model, const Eigen::VectorXd& start) {
  constexpr int most_steps = 60;
  constexpr double enough = 1e-4;
  require_usable(model);
  Likeliest best;
  best.x = start;
  best.predicted = predict(model, without_noise(best.x), true);
  best.log_posterior = log_posterior(model, best.predicted, best.x);
  double damping = 0.0;
  for (; best.steps < most_steps && !best.converged; ++best.steps) {
    const PosteriorSlope slope = posterior_slope(model, best.predicted, best.x);
    Eigen::MatrixXd damped = slope.curvature;
    damped.diagonal() *= 1.0 + damping;
    const Eigen::VectorXd step = Eigen::LLT<Eigen::MatrixXd>(damped).solve(slope.gradient);
    if (step.dot(slope.gradient) < enough) {
      best.converged = true;
      break;
    }
    const Eigen::VectorXd x = best.x + step;
    const double there = log_posterior(model, predict(model, without_noise(x), false), x);
    if (!(there > best.log_posterior)) {
      damping = std::max(10.0 * damping, 0.1);
      if (damping > 1e8) break;
      continue;
    }
    damping = damping > 0.01 ? damping / 10.0 : 0.0;
    best.x = x;
    best.predicted = predict(model, without_noise(x), true);
    best.log_posterior = there;
  }
  const PosteriorSlope slope = posterior_slope(model, best.predicted, best.x);
  best.covariance =
      Eigen::LLT<Eigen::MatrixXd>(slope.curvature).solve(Eigen::MatrixXd::Identity(best.x.size(), best.x.size()));
  return best;
}

Calibration calibrate(CutModel model, const ChainOptions& options) {
  Calibration c;
  c.model = std::move(model);
  std::vector<Likeliest> tops = maxima(c.model);
  std::vector<Region> regions;
  regions.reserve(tops.size());
  for (const Likeliest& top : tops) regions.push_back({top.x, top.covariance});
  c.likeliest = std::move(tops.front());
  InterpolatedCuts prediction(c.model, places_about(regions));
  const LogDensity dear = [&](const Eigen::VectorXd& x) {
    return log_posterior(c.model, predict(c.model, without_noise(x), false), x);
  };
  const LogDensity cheap = [&](const Eigen::VectorXd& x) {
    return log_posterior(c.model, prediction(without_noise(x)), x);
  };
  ChainOptions first = options;
  first.draws = std::clamp(options.draws / 4, 20, 50);  // each is a row of the interpolation's dense equations
  first.left_out = 10;
  prediction.add(c.model, places_of(all_draws(surrogate_chains(dear, cheap, regions, first))));
  c.chains = surrogate_chains(dear, cheap, regions, options);
  c.draws = all_draws(c.chains);
  c.parameters = learned_parameters(c);
  const ChainDiagnostics diagnostics = diagnose(c.chains.draws);
  c.worst_r_hat = diagnostics.r_hat.maxCoeff();
  c.least_effective_size = diagnostics.effective_size.minCoeff();
  std::vector<double> noise;
  for (const Eigen::VectorXd& x : c.draws) noise.push_back(noise_of(c.model, x));
  c.noise = core::median(std::move(noise));
  c.cuts = learned_cuts(c, prediction);
  return c;
}

std::vector<milling::Cut> cuts_of_draws(const Calibration& calibration, std::size_t count) {
  const std::size_t all = calibration.draws.size(), taken = std::min(count, all);
  std::vector<milling::Cut> cuts;
  for (std::size_t i = 0; i < taken; ++i) {
    const Eigen::VectorXd& x = calibration.draws[i * all / taken];
    cuts.push_back(milling::cut_at(calibration.model.nominal, calibration.model.parameters, without_noise(x)));
  }
  return cuts;
}

void count(milling::Score& score, const CutModel& model, const PredictedCuts& predicted) {
  for (std::size_t i = 0; i < model.cuts.size(); ++i)
    milling::count(score, model.cuts[i].outcome, predicted.margin(static_cast<Index>(i)) > 0.0);
}

milling::Score cross_validated(const CutModel& model, int folds) {
  milling::Score score;
  for (int fold = 0; fold < folds; ++fold) {
    CutModel taught = model, left_out = model;
    taught.cuts.clear();
    left_out.cuts.clear();
    for (std::size_t i = 0; i < model.cuts.size(); ++i)
      (static_cast<int>(i % static_cast<std::size_t>(folds)) == fold ? left_out : taught).cuts.push_back(model.cuts[i]);
    if (taught.cuts.empty() || left_out.cuts.empty()) continue;
    const PredictedCuts predicted = predict(left_out, without_noise(likeliest(taught).x), false);
    count(score, left_out, predicted);
  }
  return score;
}

}  // namespace thinwall::learning

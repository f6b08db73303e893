#include "learning/cut_likelihood.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/parallel.hpp"
#include "milling/observed/multiplier_slope.hpp"

namespace thinwall::learning {

namespace {

using Eigen::Index;
using milling::CutOutcome;

/// ln P(outcome) at t = m/κ, its derivative, and minus its second one.
struct OutcomeTerm {
  double value = 0.0, slope = 0.0, curvature = 0.0;
};

/// ln(1 + e^t), without overflow.
double softplus(double t) {
  return std::max(t, 0.0) + std::log1p(std::exp(-std::abs(t)));
}

/// ln(1 + 4p(1 − p)), by which the three probabilities add up to 1, its derivative by t, and minus its second one.
OutcomeTerm of_three(double p) {
  const double s = 4.0 * p * (1.0 - p), by = s * (1.0 - 2.0 * p);
  const double second = s * ((1.0 - 2.0 * p) * (1.0 - 2.0 * p) - 2.0 * p * (1.0 - p));
  return {std::log1p(s), by / (1.0 + s), (by * by / (1.0 + s) - second) / (1.0 + s)};
}

bool has_marginal(const CutModel& model) {
  return std::ranges::count(model.cuts, CutOutcome::marginal, &milling::ObservedCut::outcome) > 0;
}

OutcomeTerm outcome_term(CutOutcome outcome, double t, bool three) {
  const double p = 1.0 / (1.0 + std::exp(-t));
  const OutcomeTerm stable{-softplus(t), -p, p * (1.0 - p)};
  const OutcomeTerm chatter{-softplus(-t), 1.0 - p, p * (1.0 - p)};
  const OutcomeTerm marginal{stable.value + chatter.value + std::log(4.0), stable.slope + chatter.slope,
                             2.0 * stable.curvature};
  const OutcomeTerm chosen = outcome == CutOutcome::stable    ? stable
                             : outcome == CutOutcome::chatter ? chatter
                                                              : marginal;
  if (!three) return chosen;
  const OutcomeTerm all = of_three(p);
  return {chosen.value - all.value, chosen.slope - all.slope, chosen.curvature - all.curvature};
}

/// ln of the density of r over that of its peak, its derivative by r, and the weight of r² in it.
OutcomeTerm frequency_term(const CutModel& model, double r) {
  const double share = model.frequency_outlier_share;
  const double own = (1.0 - share) * std::exp(-0.5 * r * r);
  const double all = own + share * std::sqrt(2.0 * std::numbers::pi) * model.frequency_deviation / 2.0;
  return {std::log(all), -r * own / all, own / all};
}

double deviation_of_frequency(const CutModel& model, const PredictedCuts& predicted, std::size_t i) {
  const double heard = *model.cuts[i].chatter_frequency_hz;
  return (predicted.frequency_hz(static_cast<Index>(i)) - heard) / (model.frequency_deviation * heard);
}

}  // namespace

double noise_of(const CutModel& model, const Eigen::VectorXd& x) {
  return model.noise_median * std::exp(model.noise_spread * x(x.size() - 1));
}

double chatter_probability(double margin, double noise) {
  return 1.0 / (1.0 + std::exp(-margin / noise));
}

PredictedCuts predict(const CutModel& model, const Eigen::VectorXd& z, bool with_slopes) {
  const auto cuts = std::ssize(model.cuts);
  PredictedCuts all{Eigen::VectorXd(cuts), Eigen::VectorXd(cuts), {}, {}};
  if (with_slopes) all.margin_slope = all.frequency_slope = Eigen::MatrixXd::Zero(cuts, z.size());
  core::parallel_for(model.cuts.size(), [&](std::size_t i) {
    const auto row = static_cast<Index>(i);
    const milling::ObservedCut& cut = model.cuts[i];
    const milling::MultiplierSlope at =
        milling::multiplier_slope(model.nominal, model.parameters, z, {cut.spindle_speed_rpm, cut.depth_m},
                                  model.nominal.structure.poles, with_slopes);
    all.margin(row) = at.margin;
    all.frequency_hz(row) = at.frequency_hz;
    if (!with_slopes) return;
    all.margin_slope.row(row) = at.margin_by_z;
    all.frequency_slope.row(row) = at.frequency_by_z;
  });
  return all;
}

double log_posterior(const CutModel& model, const PredictedCuts& predicted, const Eigen::VectorXd& x) {
  const double noise = noise_of(model, x);
  const bool three = has_marginal(model);
  double sum = -0.5 * x.squaredNorm();
  for (std::size_t i = 0; i < model.cuts.size(); ++i) {
    sum += outcome_term(model.cuts[i].outcome, predicted.margin(static_cast<Index>(i)) / noise, three).value;
    if (model.cuts[i].chatter_frequency_hz)
      sum += frequency_term(model, deviation_of_frequency(model, predicted, i)).value;
  }
  return sum;
}

PosteriorSlope posterior_slope(const CutModel& model, const PredictedCuts& predicted, const Eigen::VectorXd& x) {
  const Index n = x.size(), parameters = n - 1;
  const double noise = noise_of(model, x);
  PosteriorSlope result{-x, Eigen::MatrixXd::Identity(n, n)};
  const bool three = has_marginal(model);
  Eigen::VectorXd by(n);
  const auto add = [&](const OutcomeTerm& term) {
    result.gradient += term.slope * by;
    result.curvature += term.curvature * by * by.transpose();
  };
  for (std::size_t i = 0; i < model.cuts.size(); ++i) {
    const auto row = static_cast<Index>(i);
    const double t = predicted.margin(row) / noise;
    by.head(parameters) = predicted.margin_slope.row(row).transpose() / noise;
    by(parameters) = -model.noise_spread * t;
    add(outcome_term(model.cuts[i].outcome, t, three));
    if (!model.cuts[i].chatter_frequency_hz) continue;
    const double scale = model.frequency_deviation * *model.cuts[i].chatter_frequency_hz;
    by.head(parameters) = predicted.frequency_slope.row(row).transpose() / scale;
    by(parameters) = 0.0;
    add(frequency_term(model, deviation_of_frequency(model, predicted, i)));
  }
  return result;
}

}  // namespace thinwall::learning

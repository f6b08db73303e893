#include "learning/next_cut.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "milling/direct/stability.hpp"
#include "milling/observed/multiplier_slope.hpp"

namespace thinwall::learning {

namespace {

using Eigen::Index;

/// A draw of the posterior as the search sees it.
struct Draw {
  milling::Cut cut;
  double noise = 0.0;
};

std::vector<Draw> some_draws(const Calibration& calibration, std::size_t count) {
  const std::size_t all = calibration.draws.size(), taken = std::min(count, all);
  std::vector<milling::Cut> cuts = cuts_of_draws(calibration, taken);
  std::vector<Draw> draws;
  for (std::size_t i = 0; i < taken; ++i)
    draws.push_back({std::move(cuts[i]), noise_of(calibration.model, calibration.draws[i * all / taken])});
  return draws;
}

/// Σ w_i (y_i − ȳ)², the weighted mean ȳ; 0 without weight.
double weighted_scatter(const Eigen::VectorXd& y, const Eigen::VectorXd& weight) {
  const double sum = weight.sum();
  if (!(sum > 0.0)) return 0.0;
  const double mean = weight.dot(y) / sum;
  return weight.dot((y.array() - mean).square().matrix());
}

/// The probability that each draw gives to chatter at a point; NaN where its margin is not finite.
Eigen::VectorXd chatter_of(const CutModel& model, const std::vector<Draw>& draws, const milling::OperatingPoint& at) {
  const Eigen::VectorXcd& poles = model.nominal.structure.poles;
  Eigen::VectorXd p(std::ssize(draws));
  for (std::size_t i = 0; i < draws.size(); ++i) {
    const milling::MultiplierSlope mu =
        milling::multiplier_slope(draws[i].cut, {}, Eigen::VectorXd(), at, poles, false);
    p(static_cast<Index>(i)) = std::isfinite(mu.margin) ? chatter_probability(mu.margin, draws[i].noise)
                                                        : std::numeric_limits<double>::quiet_NaN();
  }
  return p;
}

/// chatter_of() each candidate, a column.
Eigen::MatrixXd chatter_of_all(const CutModel& model, const std::vector<Draw>& draws,
                               const std::vector<milling::OperatingPoint>& candidates) {
  Eigen::MatrixXd chatter(std::ssize(draws), std::ssize(candidates));
  core::Progress progress("candidates of the next cut", candidates.size());
  core::parallel_for(candidates.size(), [&](std::size_t i) {
    chatter.col(static_cast<Index>(i)) = chatter_of(model, draws, candidates[i]);
    progress.step();
  });
  return chatter;
}

/// A quantity of every draw, none where it is not known.
std::vector<std::optional<double>> of_each(const std::vector<Draw>& draws,
                                           const std::function<std::optional<double>(const Draw&)>& quantity) {
  std::vector<std::optional<double>> values(draws.size());
  core::parallel_for(draws.size(), [&](std::size_t i) { values[i] = quantity(draws[i]); });
  return values;
}

/// ln of a positive quantity, for the draws that have it; the others leave the draws. Throws NumericalError if half do.
Eigen::VectorXd log_of_known(std::vector<Draw>& draws, const std::vector<std::optional<double>>& values) {
  std::vector<Draw> answered;
  std::vector<double> y;
  for (std::size_t i = 0; i < draws.size(); ++i) {
    if (!values[i]) continue;
    y.push_back(std::log(*values[i]));
    answered.push_back(std::move(draws[i]));
  }
  if (2 * y.size() < values.size())
    throw core::NumericalError("next cut: no limiting depth is found for most draws; choose other speeds");
  draws = std::move(answered);
  return Eigen::Map<const Eigen::VectorXd>(y.data(), std::ssize(y));
}

/// The candidate after which the quantity's variance is expected to be least.
std::optional<NextCut> most_telling(const CutModel& model, const std::vector<Draw>& draws, const Eigen::VectorXd& y,
                                    const std::vector<milling::OperatingPoint>& candidates) {
  const Eigen::VectorXd weights = Eigen::VectorXd::Constant(y.size(), 1.0 / static_cast<double>(y.size()));
  const Eigen::MatrixXd chatter = chatter_of_all(model, draws, candidates);
  const Eigen::VectorXd after = expected_variances(chatter, y, weights);
  const double before = std::sqrt(weighted_scatter(y, weights));
  std::optional<NextCut> best;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const auto column = static_cast<Index>(i);
    const NextCut cut{candidates[i], chatter.col(column).mean(), before, std::sqrt(after(column))};
    if (!(cut.chatter_probability <= riskiest_next_cut) || !std::isfinite(cut.deviation_after)) continue;
    if (!best || cut.deviation_after < best->deviation_after) best = cut;
  }
  return best;
}

std::vector<Draw> draws_for(const Calibration& calibration, std::size_t draws,
                            const std::vector<milling::OperatingPoint>& candidates) {
  if (draws == 0 || candidates.empty())
    throw core::InputError("next cut: it needs draws and candidates; give at least one of each");
  return some_draws(calibration, draws);
}

}  // namespace

std::optional<double> limit_at(const milling::Cut& cut, double spindle_speed_rpm, milling::StabilityOptions options) {
  options.follow = 1.0;
  return answered_limit_m(
      milling::limiting_depth(cut.structure, process_at(cut, spindle_speed_rpm), spindle_speed_rpm, options));
}

std::optional<double> answered_limit_m(const milling::LobeRow& row) {
  const bool is_doubtful = row.status == milling::StabilityStatus::crossing_missed ||
                           row.status == milling::StabilityStatus::data_insufficient;
  if (is_doubtful || !(row.limiting_depth_m > 0.0)) return std::nullopt;
  return row.limiting_depth_m;
}

Eigen::VectorXd expected_variances(const Eigen::MatrixXd& chatter, const Eigen::VectorXd& y,
                                   const Eigen::VectorXd& weights) {
  Eigen::VectorXd variances(chatter.cols());
  for (Index i = 0; i < chatter.cols(); ++i) {
    const Eigen::VectorXd chattering = weights.cwiseProduct(chatter.col(i));
    variances(i) = weighted_scatter(y, chattering) + weighted_scatter(y, weights - chattering);
  }
  return variances;
}

std::optional<double> best_speed_rpm(const std::vector<double>& speeds_rpm,
                                     const std::vector<std::optional<double>>& limits_m) {
  std::optional<double> best;
  double most = 0.0;
  for (std::size_t i = 0; i < speeds_rpm.size(); ++i) {
    if (!limits_m[i] || !(speeds_rpm[i] * *limits_m[i] > most)) continue;
    most = speeds_rpm[i] * *limits_m[i];
    best = speeds_rpm[i];
  }
  return best;
}

std::optional<NextCut> next_cut(const Calibration& calibration, std::size_t draws, double spindle_speed_rpm,
                                const std::vector<milling::OperatingPoint>& candidates) {
  std::vector<Draw> taken = draws_for(calibration, draws, candidates);
  const auto limits = of_each(
      taken, [&](const Draw& draw) { return limit_at(draw.cut, spindle_speed_rpm, calibration.model.options); });
  const Eigen::VectorXd y = log_of_known(taken, limits);
  return most_telling(calibration.model, taken, y, candidates);
}

std::optional<NextCut> next_cut_for_best_speed(const Calibration& calibration, std::size_t draws,
                                               const std::vector<double>& speeds_rpm,
                                               const std::vector<milling::OperatingPoint>& candidates) {
  const auto best = of_each(draws_for(calibration, draws, candidates), [&](const Draw& draw) {
    std::vector<std::optional<double>> limits;
    limits.reserve(speeds_rpm.size());
    for (const double rpm : speeds_rpm) limits.push_back(limit_at(draw.cut, rpm, calibration.model.options));
    return best_speed_rpm(speeds_rpm, limits);
  });
  return next_cut_for_best_speed(calibration, best, candidates);
}

std::optional<NextCut> next_cut_for_best_speed(const Calibration& calibration,
                                               const std::vector<std::optional<double>>& best_rpm,
                                               const std::vector<milling::OperatingPoint>& candidates) {
  std::vector<Draw> taken = draws_for(calibration, best_rpm.size(), candidates);
  if (taken.size() != best_rpm.size()) {
    throw core::InputError("next cut: " + std::to_string(best_rpm.size()) +
                           " best speeds, must be at most one for each of " + std::to_string(taken.size()) +
                           " draws; give fewer");
  }
  const Eigen::VectorXd y = log_of_known(taken, best_rpm);
  return most_telling(calibration.model, taken, y, candidates);
}

std::optional<NextCut> most_productive_cut(const Calibration& calibration, std::size_t draws,
                                           const std::vector<milling::OperatingPoint>& candidates, double risk) {
  if (!(risk > 0.0 && risk < 1.0))
    throw core::InputError("next cut: the risk is " + std::to_string(risk) + ", must be between 0 and 1");
  const std::vector<Draw> taken = draws_for(calibration, draws, candidates);
  const Eigen::RowVectorXd chatter = chatter_of_all(calibration.model, taken, candidates).colwise().mean();
  std::optional<NextCut> best;
  double most = 0.0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const double rate = candidates[i].spindle_speed_rpm * candidates[i].depth_m, p = chatter(static_cast<Index>(i));
    if (!(p <= risk) || !(rate > most)) continue;
    most = rate;
    best = NextCut{candidates[i], p};
  }
  return best;
}

}  // namespace thinwall::learning

#include "learning/next_cut.hpp"

#include <algorithm>
#include <cmath>
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

/// The probability that each draw gives to chatter at a point.
Eigen::VectorXd chatter_of(const CutModel& model, const std::vector<Draw>& draws, const milling::OperatingPoint& at) {
  const Eigen::VectorXcd& poles = model.nominal.structure.poles;
  Eigen::VectorXd p(std::ssize(draws));
  for (std::size_t i = 0; i < draws.size(); ++i) {
    const milling::MultiplierSlope mu =
        milling::multiplier_slope(draws[i].cut, {}, Eigen::VectorXd(), at, poles, false);
    p(static_cast<Index>(i)) = chatter_probability(mu.margin, draws[i].noise);
  }
  return p;
}

/// ln of each draw's limiting depth. Draws without an answer are left out of both; throws NumericalError if half are.
Eigen::VectorXd log_limits(std::vector<Draw>& draws, double rpm, const milling::StabilityOptions& options) {
  std::vector<std::optional<double>> limits(draws.size());
  core::parallel_for(draws.size(), [&](std::size_t i) { limits[i] = answered_limit_m(draws[i].cut, rpm, options); });
  std::vector<Draw> answered;
  std::vector<double> y;
  for (std::size_t i = 0; i < draws.size(); ++i) {
    if (!limits[i]) continue;
    y.push_back(std::log(*limits[i]));
    answered.push_back(std::move(draws[i]));
  }
  if (2 * y.size() < limits.size())
    throw core::NumericalError("next cut: no limiting depth is found for most draws; choose another speed");
  draws = std::move(answered);
  return Eigen::Map<const Eigen::VectorXd>(y.data(), std::ssize(y));
}

}  // namespace

std::optional<double> answered_limit_m(const milling::Cut& cut, double spindle_speed_rpm,
                                       milling::StabilityOptions options) {
  options.follow = 1.0;
  const milling::LobeRow row = milling::limiting_depth(cut.structure, cut.process, spindle_speed_rpm, options);
  const bool is_doubtful = row.status == milling::StabilityStatus::crossing_missed ||
                           row.status == milling::StabilityStatus::data_insufficient;
  if (is_doubtful || !(row.limiting_depth_m > 0.0)) return std::nullopt;
  return row.limiting_depth_m;
}

std::optional<NextCut> next_cut(const Calibration& calibration, std::size_t draws, double spindle_speed_rpm,
                                const std::vector<milling::OperatingPoint>& candidates) {
  if (draws == 0 || candidates.empty())
    throw core::InputError("next cut: it needs draws and candidates; give at least one of each");
  std::vector<Draw> taken = some_draws(calibration, draws);
  const Eigen::VectorXd y = log_limits(taken, spindle_speed_rpm, calibration.model.options);
  const auto n = static_cast<double>(taken.size());
  std::vector<NextCut> judged(candidates.size());
  core::Progress progress("candidates of the next cut", candidates.size());
  core::parallel_for(candidates.size(), [&](std::size_t i) {
    const Eigen::VectorXd p = chatter_of(calibration.model, taken, candidates[i]);
    const Eigen::VectorXd q = Eigen::VectorXd::Ones(p.size()) - p;
    judged[i] = {candidates[i], p.mean(), std::sqrt(weighted_scatter(y, Eigen::VectorXd::Ones(p.size())) / n),
                 std::sqrt((weighted_scatter(y, p) + weighted_scatter(y, q)) / n)};
    progress.step();
  });
  std::erase_if(judged, [](const NextCut& cut) { return cut.chatter_probability > riskiest_next_cut; });
  if (judged.empty()) return std::nullopt;
  return *std::ranges::min_element(judged, {}, &NextCut::deviation_after);
}

}  // namespace thinwall::learning

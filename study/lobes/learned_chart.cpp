#include "study/lobes/learned_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/messages.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "milling/direct/stability.hpp"
#include "setup/observed.hpp"

namespace thinwall::study {

namespace {

/// Of heard frequencies from those of a structure that was tapped at rest, relative: bearings that turn and a tool that
/// cuts shift modes by some percent.
constexpr double heard_deviation = 0.05;
constexpr std::size_t limit_draws = 60, candidate_draws = 60;
constexpr int limit_speeds = 40, candidate_speeds = 24, candidate_depths = 12;

/// Speeds and depths that fill the chart.
std::vector<milling::OperatingPoint> candidates_of(const setup::LobesOptions& lobes) {
  std::vector<milling::OperatingPoint> list;
  for (const double rpm : milling::spindle_speeds(lobes.from_rpm, lobes.to_rpm, candidate_speeds)) {
    for (int d = 1; d <= candidate_depths; ++d)
      list.push_back({rpm, std::min(lobes.depth_limit, lobes.depth_limit * d / candidate_depths)});
  }
  return list;
}

/// The value that a share of the ascending list reaches at least.
double reached_by(const std::vector<double>& ascending, double share) {
  const auto at = static_cast<std::size_t>(std::floor((1.0 - share) * static_cast<double>(ascending.size())));
  return ascending[std::min(at, ascending.size() - 1)];
}

std::vector<LearnedChart::Row> limits_of_draws(const setup::LobesOptions& lobes, const learning::Calibration& learned,
                                               milling::StabilityOptions options) {
  const std::vector<double> speeds = milling::spindle_speeds(lobes.from_rpm, lobes.to_rpm, limit_speeds);
  const std::vector<milling::Cut> cuts = learning::cuts_of_draws(learned, limit_draws);
  options.follow = 1.0;
  const auto limit = [&](const milling::Cut& cut, double rpm) {
    return milling::limiting_depth(cut.structure, cut.process, rpm, options).limiting_depth_m;
  };
  std::vector<LearnedChart::Row> rows(speeds.size());
  core::Progress progress("limits of the draws", speeds.size());
  core::parallel_for(speeds.size(), [&](std::size_t i) {
    std::vector<double> limits;
    for (const milling::Cut& cut : cuts) limits.push_back(limit(cut, speeds[i]));
    std::ranges::sort(limits);
    rows[i] = {speeds[i], limit(learned.model.nominal, speeds[i]), reached_by(limits, 0.5), reached_by(limits, 0.9),
               reached_by(limits, 0.95)};
    progress.step();
  });
  return rows;
}

milling::Score score_of(const learning::CutModel& model, const learning::PredictedCuts& predicted) {
  milling::Score score;
  for (std::size_t i = 0; i < model.cuts.size(); ++i) {
    if (model.cuts[i].outcome == milling::CutOutcome::marginal) continue;
    ++score.of;
    const bool chatters = predicted.margin(static_cast<Eigen::Index>(i)) > 0.0;
    score.right += chatters == (model.cuts[i].outcome == milling::CutOutcome::chatter) ? 1 : 0;
  }
  return score;
}

void tell_of_doubt(const learning::Calibration& learned) {
  if (!learned.likeliest.converged)
    core::warn("calibration: the likeliest parameters were not found within 60 steps; fewer uncertain ones may be");
  if (learned.worst_r_hat > 1.1) {
    core::warn(fmt::format("calibration: the chains differ (R-hat {:.3f}, above 1.1); raise calibration.draws",
                           learned.worst_r_hat));
  }
}

}  // namespace

learning::CutModel cut_model(const setup::CutSetup& source, const milling::Cut& nominal,
                             const milling::StabilityOptions& options) {
  learning::CutModel model;
  model.nominal = nominal;
  if (source.lobes->robust)
    model.parameters = milling::uncertain_parameters(nominal, source.lobes->robust->uncertainty);
  model.cuts = setup::all_cuts(source.observed);
  model.options = options;
  model.frequency_deviation = heard_deviation;
  return model;
}

LearnedChart learned_chart(const setup::CutSetup& source, const milling::Cut& nominal,
                           const milling::StabilityOptions& options) {
  const setup::Calibration& wanted = *source.calibration;
  learning::ChainOptions chains;
  chains.draws = wanted.draws;
  chains.left_out = std::max(8, wanted.draws / 5);
  chains.seed = static_cast<unsigned>(wanted.seed);
  LearnedChart chart;
  chart.calibration = learning::calibrate(cut_model(source, nominal, options), chains);
  tell_of_doubt(chart.calibration);
  const learning::CutModel& model = chart.calibration.model;
  const Eigen::VectorXd nothing_learned = Eigen::VectorXd::Zero(std::ssize(model.parameters));
  chart.before = score_of(model, learning::predict(model, nothing_learned, false));
  if (wanted.folds) chart.cross_validated = learning::cross_validated(model, *wanted.folds);
  chart.rows = limits_of_draws(*source.lobes, chart.calibration, options);
  const auto rpm = wanted.spindle_speed_rpm ? wanted.spindle_speed_rpm : source.cutting->spindle_speed_rpm;
  if (rpm) chart.next = learning::next_cut(chart.calibration, candidate_draws, *rpm, candidates_of(*source.lobes));
  return chart;
}

}  // namespace thinwall::study

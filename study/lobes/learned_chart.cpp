#include "study/lobes/learned_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/messages.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "learning/parameter_limit.hpp"
#include "milling/direct/stability.hpp"
#include "setup/observed.hpp"
#include "study/lobes/machine_load.hpp"

namespace thinwall::study {

namespace {

/// Of heard frequencies from those of a structure that was tapped at rest, relative: bearings that turn and a tool that
/// cuts shift modes by some percent. Chosen by the cuts of cases/hajdu-2020 that were left out, after 0.02 and 0.035
/// had been seen (docs/theory/calibration.md).
constexpr double heard_deviation = 0.05;
/// The deviation of the exponent by which coefficients fall with the speed, a choice: chips are hotter and softer in
/// faster cuts.
constexpr double usual_speed_exponent = 0.2;
constexpr std::size_t limit_draws = 60, candidate_draws = 60;
constexpr int limit_speeds = 40, candidate_speeds = 24, candidate_depths = 12;

/// Speeds and depths that fill the chart, shallow ones more densely, and that the machine can do by the cut's forces.
std::vector<milling::OperatingPoint> candidates_of(const setup::CutSetup& source, const milling::Cut& cut) {
  const setup::LobesOptions& lobes = *source.lobes;
  const milling::MachineLimits machine = source.machine.value_or(milling::MachineLimits{});
  std::vector<milling::OperatingPoint> list;
  for (const double rpm : milling::spindle_speeds(lobes.from_rpm, lobes.to_rpm, candidate_speeds)) {
    const std::optional<milling::CutLoad> load = load_of(source, milling::process_at(cut, rpm));
    for (int d = 1; d <= candidate_depths; ++d) {
      const double share = static_cast<double>(d) / candidate_depths;
      const milling::OperatingPoint point{rpm, lobes.depth_limit * share * share};
      if (can_do(machine, load, point)) list.push_back(point);
    }
  }
  return list;
}

/// The value that a share of the ascending list reaches at least.
double reached_by(const std::vector<double>& ascending, double share) {
  // 1 − 0.9 is a little below a tenth.
  const auto at = static_cast<std::size_t>(std::floor((1.0 - share) * static_cast<double>(ascending.size()) + 1e-9));
  return ascending[std::min(at, ascending.size() - 1)];
}

std::vector<LimitsAtSpeed> limits_of_draws(const setup::LobesOptions& lobes, const learning::Calibration& learned,
                                           const milling::StabilityOptions& options) {
  const std::vector<double> speeds = milling::spindle_speeds(lobes.from_rpm, lobes.to_rpm, limit_speeds);
  const std::vector<milling::Cut> cuts = learning::cuts_of_draws(learned, limit_draws);
  std::vector<LimitsAtSpeed> limits(speeds.size());
  core::Progress progress("limits of the draws", speeds.size());
  core::parallel_for(speeds.size(), [&](std::size_t i) {
    const auto limit_of = [&](const milling::Cut& cut) { return learning::limit_at(cut, speeds[i], options); };
    limits[i] = {speeds[i], limit_of(learned.model.nominal), {}};
    for (const milling::Cut& cut : cuts) limits[i].of_draws.push_back(limit_of(cut));
    progress.step();
  });
  return limits;
}

/// The speed at which each draw removes most.
std::vector<std::optional<double>> best_speeds(const std::vector<LimitsAtSpeed>& limits) {
  std::vector<double> speeds;
  speeds.reserve(limits.size());
  for (const LimitsAtSpeed& at : limits) speeds.push_back(at.spindle_speed_rpm);
  std::vector<std::optional<double>> best;
  for (std::size_t draw = 0; draw < limits.front().of_draws.size(); ++draw) {
    std::vector<std::optional<double>> of_draw;
    of_draw.reserve(limits.size());
    for (const LimitsAtSpeed& at : limits) of_draw.push_back(at.of_draws[draw]);
    best.push_back(learning::best_speed_rpm(speeds, of_draw));
  }
  return best;
}

void warn_of_missing(const char* cut, double risk) {
  core::warn(
      fmt::format("calibration: no {} cut, since every cut of the chart lies beyond [machine] or chatters with "
                  "a probability above {:g}; look at the limits of [machine]",
                  cut, risk));
}

/// The cut to make next for a speed, or for the best one by the limits; a warning where there is none.
std::optional<learning::NextCut> told_next_cut(const learning::Calibration& learned, std::optional<double> rpm,
                                               const std::vector<LimitsAtSpeed>& limits,
                                               const std::vector<milling::OperatingPoint>& candidates) {
  std::optional<learning::NextCut> next;
  try {
    if (!candidates.empty())
      next = rpm ? learning::next_cut(learned, candidate_draws, *rpm, candidates)
                 : learning::next_cut_for_best_speed(learned, best_speeds(limits), candidates);
  } catch (const core::NumericalError& error) {
    core::warn(fmt::format("calibration: no next cut: {}", error.what()));
    return std::nullopt;
  }
  if (!next) warn_of_missing("next", learning::riskiest_next_cut);
  return next;
}

/// The cuts to make next, or a warning where every one is beyond the machine or too likely to chatter.
void add_next_cuts(LearnedChart& chart, const setup::CutSetup& source, const std::vector<LimitsAtSpeed>& limits,
                   const std::vector<milling::OperatingPoint>& candidates) {
  const setup::Calibration& wanted = *source.calibration;
  chart.next_for_rpm = wanted.spindle_speed_rpm ? wanted.spindle_speed_rpm : source.cutting->spindle_speed_rpm;
  chart.next = told_next_cut(chart.calibration, chart.next_for_rpm, limits, candidates);
  if (!wanted.risk) return;
  if (!candidates.empty())
    chart.productive = learning::most_productive_cut(chart.calibration, candidate_draws, candidates, *wanted.risk);
  if (!chart.productive) warn_of_missing("productive", *wanted.risk);
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

std::vector<LearnedChart::Row> answered_rows(const std::vector<LimitsAtSpeed>& limits) {
  std::vector<LearnedChart::Row> rows;
  std::size_t draws = 0, missed = 0;
  for (const LimitsAtSpeed& at : limits) {
    std::vector<double> known;
    for (const std::optional<double>& limit : at.of_draws)
      if (limit) known.push_back(*limit);
    draws += at.of_draws.size();
    missed += at.of_draws.size() - known.size();
    if (!at.nominal || 2 * known.size() < at.of_draws.size()) continue;
    std::ranges::sort(known);
    rows.push_back(
        {at.spindle_speed_rpm, *at.nominal, reached_by(known, 0.5), reached_by(known, 0.9), reached_by(known, 0.95)});
  }
  if (missed > 0 || rows.size() < limits.size()) {
    core::warn(
        fmt::format("calibration: of {} limits of draws {} are left out, for their search missed a crossing; of "
                    "{} speeds {} have no learned limit",
                    draws, missed, limits.size(), limits.size() - rows.size()));
  }
  return rows;
}

namespace {

/// The geometric mean of the speeds of the cuts.
double middle_speed_rpm(const std::vector<milling::ObservedCut>& cuts) {
  double sum = 0.0;
  for (const milling::ObservedCut& cut : cuts) sum += std::log(cut.spindle_speed_rpm);
  return std::exp(sum / static_cast<double>(cuts.size()));
}

/// Adds the exponent by which the coefficients fall with the speed. Its deviation is [calibration]'s or, without that,
/// usual_speed_exponent, at most what the coefficients are uncertain by: a speed e times as high then changes them by
/// no more than that. Without that key, coefficients that are certain have none, nor does a model of most_parameters,
/// which is told.
void add_speed_exponent(learning::CutModel& model, const setup::CutSetup& source) {
  if (!source.calibration || model.cuts.empty()) return;
  const double of_coefficients = source.lobes->robust ? source.lobes->robust->uncertainty.coefficients : 0.0;
  const std::optional<double> given = source.calibration->speed_exponent;
  const double spread = given.value_or(std::min(usual_speed_exponent, of_coefficients));
  if (!(spread > 0.0)) return;
  if (!given && std::ssize(model.parameters) >= learning::most_parameters) {
    core::warn(
        fmt::format("calibration: no speed exponent, since {} parameters are uncertain already; set what is "
                    "known in [lobes.uncertainty] to 0",
                    model.parameters.size()));
    return;
  }
  model.nominal.reference_rpm = middle_speed_rpm(model.cuts);
  model.parameters.push_back({milling::ParameterOf::speed_exponent, -1, spread});
}

/// The cut with what was learned, whose forces ask of the machine what they were found to be.
milling::Cut likeliest_cut(const learning::Calibration& learned) {
  const learning::CutModel& model = learned.model;
  return milling::cut_at(model.nominal, model.parameters, learned.likeliest.x.head(std::ssize(model.parameters)));
}

}  // namespace

learning::CutModel cut_model(const setup::CutSetup& source, const milling::Cut& nominal,
                             const milling::StabilityOptions& options) {
  learning::CutModel model;
  model.nominal = nominal;
  if (source.lobes->robust)
    model.parameters = milling::uncertain_parameters(nominal, source.lobes->robust->uncertainty);
  model.cuts = setup::all_cuts(source.observed);
  add_speed_exponent(model, source);
  if (std::ssize(model.parameters) > learning::most_parameters) {
    throw core::InputError(
        fmt::format("calibration: {} parameters are uncertain, must be at most {}; set what is known in "
                    "[lobes.uncertainty] to 0, or give fewer modes (lobes.modes_up_to)",
                    model.parameters.size(), learning::most_parameters));
  }
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
  learning::count(chart.before.emplace(), model, learning::predict(model, nothing_learned, false));
  if (wanted.folds) chart.cross_validated = learning::cross_validated(model, *wanted.folds);
  const std::vector<LimitsAtSpeed> limits = limits_of_draws(*source.lobes, chart.calibration, options);
  chart.rows = answered_rows(limits);
  add_next_cuts(chart, source, limits, candidates_of(source, likeliest_cut(chart.calibration)));
  return chart;
}

}  // namespace thinwall::study

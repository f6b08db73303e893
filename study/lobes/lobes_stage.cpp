#include "study/lobes/lobes_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <variant>

#include "core/error.hpp"
#include "core/messages.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "core/units.hpp"
#include "milling/chart/near_crossing.hpp"
#include "milling/chart/refined_lobes.hpp"
#include "milling/chart/sampled_stability.hpp"
#include "milling/direct/stability.hpp"
#include "setup/milling_process.hpp"
#include "study/kept/kept_part.hpp"
#include "study/lobes/cut_structure.hpp"
#include "study/lobes/learned_chart.hpp"
#include "study/lobes/lobe_sensitivity.hpp"
#include "study/lobes/low_limit.hpp"
#include "study/lobes/machine_load.hpp"
#include "study/lobes/main_modes.hpp"
#include "study/lobes/observed_cuts.hpp"

namespace thinwall::study {

namespace {

/// The data from which a chart and its answers are computed; `poles` is null where the structure is known by samples.
struct Chart {
  CutStructure structure;
  milling::MillingProcess process;
  milling::MethodOptions options;
  bool direct = true;

  [[nodiscard]] const milling::RelativeStructure* poles() const {
    return std::get_if<milling::RelativeStructure>(&structure);
  }
  [[nodiscard]] milling::Lobes by(milling::Method method, const std::vector<double>& speeds_rpm,
                                  const milling::KeptRows& kept = {}) const {
    if (const auto* sampled = std::get_if<milling::FittedStructure>(&structure))
      return milling::lobes_by_lines(*sampled, process, speeds_rpm, options.stability, kept);
    return milling::stability_lobes(*milling::lobe_method(method, *poles(), process, options), speeds_rpm, kept);
  }
  [[nodiscard]] milling::RowAt row_at(milling::Method method) const {
    return [this, method](double rpm, const milling::StabilityOptions& with) {
      if (const auto* sampled = std::get_if<milling::FittedStructure>(&structure))
        return milling::row_by_lines(*sampled, process, rpm, with);
      milling::MethodOptions all = options;
      all.stability = with;
      return milling::lobe_method(method, *poles(), process, all)->limiting_depth(rpm, with.expected_depth_m);
    };
  }
  /// Widens the estimate of a row by row_at() for what the lines leave open of other crossings.
  void widen(milling::LobeRow& row) const {
    if (const auto* sampled = std::get_if<milling::FittedStructure>(&structure))
      milling::widen_for_near_crossings(*sampled, process, options.stability, row);
  }
  /// Sensitivities of a crossing that the direct method gave from poles; else empty.
  [[nodiscard]] std::vector<ParameterSensitivity> sensitivities(double rpm, const milling::LobePoint& point) const {
    if (!direct || poles() == nullptr) return {};
    return parameter_sensitivities(*poles(), process, rpm, point, options.stability);
  }
};

std::vector<double> speeds_of(const milling::Lobes& lobes) {
  std::vector<double> speeds(lobes.rows.size());
  std::ranges::transform(lobes.rows, speeds.begin(), &milling::LobeRow::spindle_speed_rpm);
  return speeds;
}

/// The chart, its line refined, and its rows widened after that; the case's own speed and those of the points lie on
/// it.
milling::Lobes refined_chart(const setup::CutSetup& source, const Chart& chart,
                             const std::vector<milling::OperatingPoint>& points, const milling::KeptRows& kept) {
  const setup::LobesOptions& wanted = *source.lobes;
  const auto* sampled = std::get_if<milling::FittedStructure>(&chart.structure);
  const double narrow = sampled == nullptr ? milling::narrow_gap : milling::narrow_gap_by_lines;
  milling::Lobes lobes =
      milling::refined(chart.by(wanted.method, even_speeds(wanted), kept), chart.row_at(wanted.method), chart.process,
                       chart.options.stability, {wanted.line_tolerance, setup::most_added(wanted), narrow},
                       asked_speeds(source, points), kept);
  if (sampled == nullptr) return lobes;
  return milling::widened_for_near_crossings(*sampled, chart.process, chart.options.stability, std::move(lobes));
}

/// Errors of the limiting depths, and at the case's own speed; the rows share out among the threads.
void add_errors(const setup::CutSetup& source, const Chart& chart, const StructureErrors& errors, Checkpoint& kept,
                StructureLobes& result) {
  if (errors.none() || (chart.poles() != nullptr && !chart.direct)) return;  // crossings of other methods are their own
  const auto at = [&](const milling::LobeRow& row) {
    return depth_error(chart.structure, errors, chart.process, row, chart.options.stability);
  };
  result.errors = errors_of_checkpoint(kept, core::word_of(result.of), speeds_of(result.lobes), [&] {
    std::vector<DepthError> list(result.lobes.rows.size());
    core::Progress progress("errors of limits", list.size());
    core::parallel_for(list.size(), [&](std::size_t i) {
      list[i] = at(result.lobes.rows[i]);
      progress.step();
    });
    return list;
  });
  if (!result.at_spindle_speed) return;
  result.error_at_spindle_speed = at(*result.at_spindle_speed);
  const auto* sampled = std::get_if<milling::FittedStructure>(&chart.structure);
  if (!source.lobes->noise_samples || sampled == nullptr || errors.noise.empty()) return;
  result.scatter = milling::sampled_depths(*sampled, chart.process, result.at_spindle_speed->spindle_speed_rpm,
                                           chart.options.stability, errors.noise, *source.lobes->noise_samples,
                                           static_cast<std::uint64_t>(source.lobes->seed));
}

/// Of a stable point; none without poles or a feed. What the library does not model is a warning.
std::optional<milling::ForcedVibration> forced_at(const setup::CutSetup& source, const PointStability& found,
                                                  const Chart& chart) {
  const auto feed = setup::feed_per_tooth(source);
  if (chart.poles() == nullptr || !feed || !found.stable) return std::nullopt;
  try {
    return milling::forced_vibration(*chart.poles(), chart.process, found.point.spindle_speed_rpm, found.point.depth_m,
                                     *feed);
  } catch (const core::InputError& error) {
    core::warn(error.what());
  } catch (const core::NumericalError& error) {
    core::warn(fmt::format("no forced vibration: {}", error.what()));
  }
  return std::nullopt;
}

/// |μ| where there are poles, and the margins to the boundary.
PointStability stability_of(const milling::OperatingPoint& point, const Chart& chart, milling::Method method,
                            const milling::Lobes& lobes) {
  const milling::StabilityOptions& options = chart.options.stability;
  const milling::RowAt row_at = chart.row_at(method);
  PointStability result;
  result.point = point;
  milling::LobeRow row = milling::row_to(row_at, point, options);
  chart.widen(row);
  result.stable = milling::stable_at(row, point.depth_m);
  result.depth = milling::depth_margin(row, point.depth_m);
  result.speed = milling::speed_margin(row_at, lobes.rows, point, options);
  result.status = row.status;
  if (chart.poles() == nullptr) return result;
  if (!result.depth.at_limit)
    result.sensitivities = chart.sensitivities(point.spindle_speed_rpm, result.depth.boundary);
  result.multiplier = milling::lobe_method(method, *chart.poles(), chart.process, chart.options)
                          ->multiplier_at(point.spindle_speed_rpm, point.depth_m);
  if (result.multiplier->status != milling::StabilityStatus::converged) {
    // The crossings' word, which converged by itself, stands.
    if (result.status == milling::StabilityStatus::converged) result.status = result.multiplier->status;
  } else if ((result.multiplier->modulus < 1.0) != result.stable) {
    // The two disagree on the boundary itself only, unless a crossing was missed.
    const bool on_boundary = std::abs(result.depth.margin_m) <= 1e-3 * point.depth_m;
    if (!on_boundary) result.status = milling::StabilityStatus::crossing_missed;
    result.stable = result.multiplier->modulus < 1.0;
  }
  return result;
}

/// Holds the cuts that were made against the chart; they share out among the threads.
void add_observed(const setup::CutSetup& source, const Chart& chart, StructureLobes& result) {
  const std::vector<milling::ObservedCut> cuts = setup::all_cuts(source.observed);
  result.observed.resize(cuts.size());
  core::Progress progress("observed cuts", cuts.size());
  core::parallel_for(cuts.size(), [&](std::size_t i) {
    const milling::OperatingPoint point{cuts[i].spindle_speed_rpm, cuts[i].depth_m};
    result.observed[i] = {cuts[i], stability_of(point, chart, source.lobes->method, result.lobes), {}, {}, {}};
    progress.step();
  });
  if (chart.poles() == nullptr) {
    if (source.calibration) {
      core::warn(
          fmt::format("calibration: it needs poles, and the structure of the chart \"{}\" is known by samples "
                      "only, so that nothing is learned; fit modes to what was measured (fit = true)",
                      core::word_of(result.of)));
    }
    return;
  }
  const milling::Cut nominal{*chart.poles(), chart.process};
  const std::vector<double> probability = chatter_probabilities(source, nominal, chart.options.stability);
  for (std::size_t i = 0; i < probability.size(); ++i) {
    result.observed[i].chatter_probability = probability[i];
    result.observed[i].certainty = certainty_of(probability[i], source.lobes->robust->confidence);
  }
  const std::vector<bool> textbook = textbook_verdicts(source, nominal, chart.options);
  for (std::size_t i = 0; i < textbook.size(); ++i) result.observed[i].textbook_stable = textbook[i];
  if (source.calibration) result.learned = learned_chart(source, nominal, chart.options.stability);
}

ComparedLobes compared(const Chart& chart, const milling::Lobes& reference, milling::Method method) {
  ComparedLobes result{milling::name(method), chart.by(method, speeds_of(reference))};
  for (std::size_t i = 0; i < reference.rows.size(); ++i) {
    const milling::LobeRow& row = reference.rows[i];
    const double difference = std::abs(result.lobes.rows[i].limiting_depth_m / row.limiting_depth_m - 1.0);
    if (i > 0 && difference <= result.largest_difference) continue;
    result.largest_difference = difference;
    result.at_spindle_speed_rpm = row.spindle_speed_rpm;
  }
  return result;
}

/// A comparison that fails leaves the chart as it is.
void add_compared(const Chart& chart, milling::Method method, StructureLobes& result) {
  try {
    result.compared.push_back(compared(chart, result.lobes, method));
  } catch (const core::InputError& error) {
    core::warn(fmt::format("no chart by {} to compare with: {}", milling::name(method), error.what()));
  } catch (const core::NumericalError& error) {
    core::warn(fmt::format("no chart by {} to compare with: {}", milling::name(method), error.what()));
  }
}

milling::StabilityMap map_of(const Chart& chart, const std::vector<double>& speeds_rpm, const milling::Lobes& lobes,
                             int count) {
  double deepest = 0.0;
  for (const milling::LobeRow& row : lobes.rows) deepest = std::max(deepest, row.limiting_depth_m);
  std::vector<double> depths(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < depths.size(); ++i) depths[i] = deepest * static_cast<double>(i + 1) / count;
  return milling::stability_map(*chart.poles(), chart.process, speeds_rpm, depths, chart.options.stability);
}

/// The rows with the robust depths in place of the limits.
std::vector<milling::LobeRow> robust_rows(std::vector<milling::LobeRow> rows, const milling::RobustLobes& robust) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].limiting_depth_m = robust.rows[i].depth_m;
    rows[i].at_limit = robust.rows[i].at_limit;
  }
  return rows;
}

const milling::LobeRow& least_row(const milling::Lobes& lobes) {
  return *std::ranges::min_element(lobes.rows, {}, &milling::LobeRow::limiting_depth_m);
}

void tell_of_doubt(const StructureLobes& chart) {
  if (!chart.doubtful) return;
  core::warn(
      fmt::format("the limit hangs on lines below the first resonance (chatter at {:.1f} Hz, first resonance at {:.1f} "
                  "Hz): look at the measured FRFs there, and bound their band by from",
                  chart.doubtful->chatter_frequency_hz, chart.doubtful->first_resonance_hz));
}

void add_pockets(const setup::CutSetup& source, const milling::MillingProcess& process, StructureLobes& result) {
  constexpr std::size_t most = 5;
  const milling::MachineLimits machine = source.machine.value_or(milling::MachineLimits{});
  const std::optional<milling::CutLoad> load = load_of(source, process);
  result.pockets = milling::best_pockets(result.lobes.rows, machine, load, most);
  if (!result.robust) return;
  result.robust_pockets = milling::best_pockets(robust_rows(result.lobes.rows, *result.robust), machine, load, most);
  std::erase_if(result.robust_pockets, [](const milling::Pocket& pocket) { return pocket.depth_m == 0.0; });
}

}  // namespace

std::vector<double> even_speeds(const setup::LobesOptions& wanted) {
  return milling::spindle_speeds(wanted.from_rpm, wanted.to_rpm, wanted.count);
}

std::vector<double> asked_speeds(const setup::CutSetup& source, const std::vector<milling::OperatingPoint>& points) {
  std::vector<double> asked;
  if (const auto rpm = source.cutting->spindle_speed_rpm) asked.push_back(*rpm);
  for (const auto& point : points) asked.push_back(point.spindle_speed_rpm);
  return asked;
}

milling::StabilityOptions stability_options(const setup::LobesOptions& wanted) {
  milling::StabilityOptions options;
  options.depth_limit_m = wanted.depth_limit;
  options.error_tolerance = wanted.tolerance;
  return options;
}

milling::MethodOptions method_options(const setup::LobesOptions& wanted) {
  milling::MethodOptions options;
  options.stability = stability_options(wanted);
  options.steps_per_period = wanted.steps_per_period.value_or(options.steps_per_period);
  options.harmonics = wanted.harmonics.value_or(options.harmonics);
  return options;
}

StructureLobes compute_lobes(const setup::CutSetup& source, ChartOf of, CutStructure structure,
                             const StructureErrors& errors, const std::vector<milling::OperatingPoint>& points,
                             Checkpoint& kept) {
  const setup::LobesOptions& wanted = *source.lobes;
  const milling::MillingProcess process = setup::milling_process(source);
  const Chart chart{std::move(structure), process, method_options(wanted), wanted.method == milling::Method::direct};
  StructureLobes result;
  result.of = of;
  result.main_modes_hz = main_modes_hz(chart.structure);
  result.lobes = refined_chart(source, chart, points, kept_rows(kept, core::word_of(of)));
  if (const auto rpm = source.cutting->spindle_speed_rpm) {
    result.at_spindle_speed = chart.row_at(wanted.method)(*rpm, chart.options.stability);
    chart.widen(*result.at_spindle_speed);
    if (!result.at_spindle_speed->crossings.empty())
      result.sensitivities = chart.sensitivities(*rpm, result.at_spindle_speed->crossings.front());
  }
  result.doubtful = limit_below_resonance(chart.structure,
                                          result.at_spindle_speed ? *result.at_spindle_speed : least_row(result.lobes));
  tell_of_doubt(result);
  add_errors(source, chart, errors, kept, result);
  for (const auto& point : points) {
    result.points.push_back(stability_of(point, chart, wanted.method, result.lobes));
    result.points.back().forced = forced_at(source, result.points.back(), chart);
  }
  add_observed(source, chart, result);
  if (chart.poles() == nullptr) {
    // The checks refuse for a measured tool what needs poles; a chart with a measured robot goes without it.
    add_pockets(source, process, result);
    return result;
  }
  for (const milling::Method method : wanted.compare) add_compared(chart, method, result);
  if (wanted.map_depths) result.map = map_of(chart, even_speeds(wanted), result.lobes, *wanted.map_depths);
  if (wanted.robust) {
    result.robust = milling::robust_lobes(*chart.poles(), process, speeds_of(result.lobes), chart.options.stability,
                                          wanted.robust->uncertainty, wanted.robust->confidence);
  }
  add_pockets(source, process, result);
  return result;
}

void require_chart_of(const setup::CutSetup& source, const std::vector<milling::OperatingPoint>& points) {
  if (points.empty()) return;
  if (!source.lobes || !source.cutting || !source.tool)
    throw core::InputError("an operating point needs a chart; add [tool], [cutting] and [lobes] to the case");
  for (const auto& point : points) {
    if (point.depth_m <= source.lobes->depth_limit) continue;
    throw core::InputError("operating point at " + core::readable_text(point.depth_m, core::kind::length) +
                           ": deeper than the chart goes, " +
                           core::readable_text(source.lobes->depth_limit, core::kind::length) +
                           " (lobes.depth_limit, else tool.length); give a smaller depth or raise the limit");
  }
}

}  // namespace thinwall::study

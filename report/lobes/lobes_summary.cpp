#include "report/lobes/lobes_summary.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "report/finite_number.hpp"
#include "report/lobes/learned_summary.hpp"
#include "report/lobes/observed_summary.hpp"

namespace thinwall::report {

namespace {

/// The depth limit is the tool's length unless the case says less.
std::string depth_limit_name(const setup::Setup& source) {
  const bool whole_edge = source.tool && source.lobes->depth_limit >= source.tool->length;
  return whole_edge ? "tool_length" : milling::name(milling::PocketLimit::depth_limit);
}

std::string limit_name(const setup::Setup& source, milling::PocketLimit limit) {
  return limit == milling::PocketLimit::depth_limit ? depth_limit_name(source) : milling::name(limit);
}

ComparedSummary compared_summary(const study::ComparedLobes& other) {
  return {.name = other.method,
          .method = other.lobes.method,
          .minimum_depth_m = other.lobes.minimum_depth_m,
          .minimum_at_spindle_speed_rpm = other.lobes.at_spindle_speed_rpm,
          .error_estimate_relative = finite(other.lobes.worst_error_estimate),
          .speeds_not_converged = other.lobes.rows_not_converged,
          .largest_relative_difference = other.largest_difference,
          .at_spindle_speed_rpm = other.at_spindle_speed_rpm};
}

MapSummary map_summary(const milling::StabilityMap& map) {
  return {.speeds = std::ssize(map.spindle_speeds_rpm),
          .depths = std::ssize(map.depths_m),
          .largest_depth_m = map.depths_m.back(),
          .largest_modulus = map.modulus.maxCoeff(),
          .error_estimate = finite(map.worst_error_estimate),
          .speeds_not_converged = map.speeds_not_converged};
}

LineSummary line_summary(const milling::DrawnLine& line) {
  return {.tolerance = line.tolerance,
          .error_estimate_relative = finite(line.error_estimate),
          .at_spindle_speed_rpm = line.at_spindle_speed_rpm,
          .speeds_added = line.speeds_added,
          .met = line.met};
}

/// Takes a value and its speed where there is none yet, or where `better` says so.
template <class Better>
void take_extreme(std::optional<double>& value, std::optional<double>& at_rpm, double candidate, double rpm,
                  Better better) {
  if (value && !better(candidate, *value)) return;
  value = candidate;
  at_rpm = rpm;
}

void add_row(ForcedOverSpeedSummary& summary, double rpm, const study::ForcedFigures& figures) {
  const auto larger = [](double a, double b) { return std::abs(a) > std::abs(b); };
  const auto smaller = [](double a, double b) { return std::abs(a) < std::abs(b); };
  ++summary.speeds_stable;
  take_extreme(summary.peak_force_n, summary.peak_force_at_rpm, figures.peak_force_n, rpm, larger);
  if (const auto error = figures.surface_location_error_m) {
    take_extreme(summary.largest_surface_error_m, summary.largest_surface_error_at_rpm, *error, rpm, larger);
    take_extreme(summary.least_surface_error_m, summary.least_surface_error_at_rpm, *error, rpm, smaller);
  }
  if (!figures.contact) return;
  summary.preload_n = figures.contact->preload_n;
  summary.speeds_contact_lost = summary.speeds_contact_lost.value_or(0) + (figures.contact->lost ? 1 : 0);
  take_extreme(summary.least_contact_force_n, summary.least_contact_force_at_rpm, figures.contact->least_n, rpm,
               std::less{});
}

ForcedOverSpeedSummary forced_summary(const study::ForcedOverSpeed& forced) {
  ForcedOverSpeedSummary summary;
  summary.depth_m = forced.depth_m;
  summary.feed_per_tooth_m = forced.feed_per_tooth_m;
  summary.speeds = std::ssize(forced.rows);
  double worst = 0.0;
  for (const study::ForcedRow& row : forced.rows) {
    if (!row.figures) continue;
    add_row(summary, row.spindle_speed_rpm, *row.figures);
    worst = std::max(worst, row.figures->error_estimate);
  }
  if (summary.speeds_stable > 0) summary.error_estimate_relative = finite(worst);
  return summary;
}

}  // namespace

CuttingSummary cutting_summary(const setup::Setup& source) {
  CuttingSummary cutting;
  cutting.teeth = source.tool->teeth;
  cutting.depth_limit_m = source.lobes->depth_limit;
  cutting.depth_limit_is = depth_limit_name(source);
  if (source.part || !source.measured_part.empty()) cutting.at = source.cutting->at;
  if (source.cutting->spindle_speed_rpm) cutting.spindle_speed_rpm = *source.cutting->spindle_speed_rpm;
  if (!source.machine) return cutting;
  cutting.spindle_range_rpm = {source.machine->min_spindle_speed_rpm, finite(source.machine->max_spindle_speed_rpm)};
  return cutting;
}

std::vector<PocketSummary> pockets_summary(const setup::Setup& source, const std::vector<milling::Pocket>& pockets) {
  std::vector<PocketSummary> list;
  for (const auto& pocket : pockets) {
    list.push_back(
        {pocket.spindle_speed_rpm, pocket.depth_m, pocket.at_limit, limit_name(source, pocket.limited_by), {}});
    if (const auto& rate = pocket.removal_rate_m3_s) list.back().removal_rate_cm3_per_min = *rate * 60e6;
    list.back().from_spindle_speed_rpm = pocket.from_rpm;
    list.back().to_spindle_speed_rpm = pocket.to_rpm;
    list.back().at_chart_edge = pocket.at_chart_edge;
  }
  return list;
}

std::vector<SensitivitySummary> sensitivities_summary(const std::vector<study::ParameterSensitivity>& list) {
  std::vector<SensitivitySummary> entries;
  entries.reserve(list.size());
  for (const auto& entry : list) entries.push_back({entry.parameter, entry.mode_frequency_hz, entry.value});
  return entries;
}

void add_what_was_asked(LobesSummary& chart, const setup::Setup& source, const study::StructureLobes& named) {
  if (named.lobes.line) chart.line = line_summary(*named.lobes.line);
  for (const study::ComparedLobes& other : named.compared) chart.compared.push_back(compared_summary(other));
  if (named.map) chart.map = map_summary(*named.map);
  for (const auto& forced : named.forced_over_speed) chart.forced_over_speed.push_back(forced_summary(forced));
  if (!named.observed.empty()) chart.observed = observed_summary(named.observed);
  if (named.learned) chart.learned = learned_summary(*named.learned);
  if (!named.robust) return;
  chart.robust = {.confidence = source.lobes->robust->confidence,
                  .minimum_depth_m = named.robust->minimum_depth_m,
                  .at_spindle_speed_rpm = named.robust->at_spindle_speed_rpm,
                  .speeds_not_robust = named.robust->rows_not_robust,
                  .speeds_not_converged = named.robust->rows_not_converged,
                  .best_pockets = pockets_summary(source, named.robust_pockets)};
}

}  // namespace thinwall::report

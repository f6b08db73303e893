#include "report/lobes/lobes_report.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>

#include "report/lobes/lobes_answers.hpp"
#include "report/lobes/lobes_words.hpp"
#include "report/page/limit_text.hpp"
#include "report/path_report.hpp"

namespace thinwall::report {

namespace {

/// "below 0.01 %" or "0.35 %".
std::string estimate_text(const std::optional<double>& relative) {
  if (!relative) return "unknown";
  const double percent = *relative * 100.0;
  return percent < 0.01 ? "below 0.01 %" : fmt::format("{:.2g} %", percent);
}

std::string chart_text(const LobesSummary& chart) {
  const bool all = chart.speeds_stable_to_depth_limit == chart.speeds;
  std::string text = fmt::format("  {}\n    least depth   {} {}{}\n    error         {} (estimate)\n",
                                 chart_title(chart.name), depth_text(chart.minimum_depth_m, all),
                                 all ? "at every speed" : fmt::format("at {:.0f} rpm", chart.at_spindle_speed_rpm),
                                 chart.error_budget ? range_text(chart.error_budget->at_minimum) : "",
                                 estimate_text(chart.error_estimate_relative));
  text += pockets_text(chart.best_pockets, "pockets") + asked_text(chart);
  if (const auto& best = chart.best_pocket)
    text += fmt::format("    {}: {} at {:.0f} rpm\n", best_pocket_title(chart),
                        depth_text(best->depth_m, best->at_depth_limit), best->spindle_speed_rpm);
  if (const auto& row = chart.at_case_speed) {
    text += fmt::format("    at {:.0f} rpm {}{}\n", row->spindle_speed_rpm,
                        depth_text(row->limiting_depth_m, row->at_depth_limit), range_text(row->error_budget));
    text += sensitivities_text(row->sensitivities);
  }
  return text;
}

std::string speed_text(const std::optional<double>& boundary, double rpm, const char* none) {
  return boundary ? fmt::format("{:.0f} rpm ({:+.0f})", *boundary, *boundary - rpm) : none;
}

std::string depth_margin_text(const OperatingPointSummary& p) {
  const double margin_mm = p.depth_margin_m * 1e3;
  const double percent = p.depth_margin_relative * 100.0;
  const double boundary_mm = p.depth_m * 1e3 + margin_mm;
  if (p.depth_margin_at_limit && margin_mm < 0.0)  // its row lost the crossings between
    return fmt::format("known to be stable to {:.3f} mm only", boundary_mm);
  if (p.depth_margin_at_limit)
    return fmt::format("stable to the limit of {:.3f} mm ({:+.0f} % or more)", boundary_mm, percent);
  return fmt::format("boundary at {:.3f} mm ({:+.3f} mm, {:+.1f} %), error {}", boundary_mm, margin_mm, percent,
                     estimate_text(p.depth_error_estimate_relative));
}

std::string contact_text(const ContactForceSummary& contact) {
  return fmt::format("    contact: {:.3g} to {:.3g} N of {:.3g} N preload{}\n", contact.least_force_n,
                     contact.largest_force_n, contact.preload_n,
                     contact.lost ? ": it is lost; press harder, or cut less" : "");
}

std::string forced_text(const ForcedVibrationSummary& forced) {
  std::string text = "    forced: ";
  if (const auto& error = forced.surface_location_error_m) {
    const double um = *error * 1e6;
    text += fmt::format("surface {:.3g} um{}, ", std::abs(um), um > 0.0 ? " overcut" : um < 0.0 ? " undercut" : "");
  }
  text += fmt::format("peak force {:.3g} N, torque {:.3g} N m", forced.peak_force_n, forced.peak_torque_n_m);
  if (forced.status != "converged") text += ", error " + estimate_text(forced.error_estimate_relative);
  return text + '\n';
}

std::string point_text(const OperatingPointSummary& p) {
  const double rpm = p.spindle_speed_rpm;
  std::string text = fmt::format("  {:.0f} rpm, {:.3f} mm, {}: {}", rpm, p.depth_m * 1e3, chart_title(p.chart),
                                 p.stable ? "stable" : "UNSTABLE");
  if (p.multiplier_modulus) text += fmt::format(", |mu| {:.6f}", *p.multiplier_modulus);
  if (p.chatter_frequency_hz)
    text += fmt::format(", {:.1f} Hz ({})", *p.chatter_frequency_hz, p.bifurcation.value_or(""));
  if (!is_sound(p.status)) text += ", " + p.status;
  text += fmt::format("\n    {}\n    speeds {} to {} at this depth\n", depth_margin_text(p),
                      speed_text(p.boundary_below_rpm, rpm, "from the chart's lowest"),
                      speed_text(p.boundary_above_rpm, rpm, "the chart's highest"));
  if (p.forced_vibration) text += forced_text(*p.forced_vibration);
  if (p.contact) text += contact_text(*p.contact);
  return text + sensitivities_text(p.sensitivities);
}

}  // namespace

std::string operating_points_text(const Summary& summary) {
  std::string text;
  for (const OperatingPointSummary& point : summary.operating_points) text += point_text(point);
  return text;
}

std::string lobes_report(const Summary& summary, const std::string& result_folder) {
  std::string text = "\n" + (summary.title.empty() ? summary.case_name : summary.title) + "\n\n";
  for (const LobesSummary& chart : summary.lobes) text += chart_text(chart);
  text += path_text(summary);
  if (const std::string points = operating_points_text(summary); !points.empty()) text += "\n" + points;
  for (const CheckSummary& check : summary.checks) {
    if (!check.ok) text += fmt::format("\n  expectation not met: {}\n", check.name);
  }
  return text + fmt::format("\n  {:.1f} s; results in {}\n", total_seconds(summary), result_folder);
}

}  // namespace thinwall::report

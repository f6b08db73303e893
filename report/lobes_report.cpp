#include "report/lobes_report.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>

#include "report/lobes_answers.hpp"
#include "report/lobes_words.hpp"
#include "report/path_report.hpp"

namespace thinwall::report {

namespace {

using nlohmann::json;

/// "below 0.01 %" or "0.35 %".
std::string estimate_text(const json& relative) {
  if (relative.is_null()) return "unknown";
  const double percent = relative.get<double>() * 100.0;
  return percent < 0.01 ? "below 0.01 %" : fmt::format("{:.2g} %", percent);
}

std::string chart_text(const json& chart) {
  const bool all = chart["speeds_stable_to_depth_limit"] == chart["speeds"];
  std::string text = fmt::format(
      "  {}\n    least depth   {} {}\n    error         {} (estimate)\n", chart_title(chart["name"].get<std::string>()),
      depth_text(chart["minimum_depth_m"].get<double>(), all),
      all ? "at every speed" : fmt::format("at {:.0f} rpm", chart["at_spindle_speed_rpm"].get<double>()),
      estimate_text(chart["error_estimate_relative"]));
  text += pockets_text(chart["best_pockets"], "best pockets") + asked_text(chart);
  if (chart.contains("at_case_speed")) {
    const json& row = chart["at_case_speed"];
    text += fmt::format("    at {:.0f} rpm {}\n", row["spindle_speed_rpm"].get<double>(),
                        depth_text(row["limiting_depth_m"].get<double>(), row["at_depth_limit"].get<bool>()));
    text += sensitivities_text(row["sensitivities"]);
  }
  return text;
}

std::string speed_text(const json& boundary, double rpm, const char* none) {
  if (boundary.is_null()) return none;
  return fmt::format("{:.0f} rpm ({:+.0f})", boundary.get<double>(), boundary.get<double>() - rpm);
}

std::string depth_margin_text(const json& p) {
  const double margin_mm = p["depth_margin_m"].get<double>() * 1e3;
  const double percent = p["depth_margin_relative"].get<double>() * 100.0;
  const double boundary_mm = p["depth_m"].get<double>() * 1e3 + margin_mm;
  if (p["depth_margin_at_limit"].get<bool>() && margin_mm < 0.0)  // its row lost the crossings between
    return fmt::format("known to be stable to {:.3f} mm only", boundary_mm);
  if (p["depth_margin_at_limit"].get<bool>())
    return fmt::format("stable to the limit of {:.3f} mm ({:+.0f} % or more)", boundary_mm, percent);
  return fmt::format("boundary at {:.3f} mm ({:+.3f} mm, {:+.1f} %), error {}", boundary_mm, margin_mm, percent,
                     estimate_text(p["depth_error_estimate_relative"]));
}

std::string contact_text(const json& contact) {
  return fmt::format("    contact: {:.3g} to {:.3g} N of {:.3g} N preload{}\n", contact["least_force_n"].get<double>(),
                     contact["largest_force_n"].get<double>(), contact["preload_n"].get<double>(),
                     contact["lost"].get<bool>() ? ": it is lost; press harder, or cut less" : "");
}

std::string forced_text(const json& forced) {
  std::string text = "    forced: ";
  if (const json& error = forced["surface_location_error_m"]; !error.is_null()) {
    const double um = error.get<double>() * 1e6;
    text += fmt::format("surface {:.3g} um{}, ", std::abs(um), um > 0.0 ? " overcut" : um < 0.0 ? " undercut" : "");
  }
  text += fmt::format("peak force {:.3g} N, torque {:.3g} N m", forced["peak_force_n"].get<double>(),
                      forced["peak_torque_n_m"].get<double>());
  if (forced["status"] != "converged") text += ", error " + estimate_text(forced["error_estimate_relative"]);
  return text + '\n';
}

std::string point_text(const json& p) {
  const double rpm = p["spindle_speed_rpm"].get<double>();
  std::string text =
      fmt::format("  {:.0f} rpm, {:.3f} mm, {}: {}", rpm, p["depth_m"].get<double>() * 1e3,
                  chart_title(p["chart"].get<std::string>()), p["stable"].get<bool>() ? "stable" : "UNSTABLE");
  if (!p["multiplier_modulus"].is_null()) text += fmt::format(", |mu| {:.6f}", p["multiplier_modulus"].get<double>());
  if (!p["chatter_frequency_hz"].is_null())
    text +=
        fmt::format(", {:.1f} Hz ({})", p["chatter_frequency_hz"].get<double>(), p["bifurcation"].get<std::string>());
  const auto status = p["status"].get<std::string>();
  if (status != "converged" && status != "stable_to_depth_limit") text += ", " + status;
  text += fmt::format("\n    {}\n    speeds {} to {} at this depth\n", depth_margin_text(p),
                      speed_text(p["boundary_below_rpm"], rpm, "from the chart's lowest"),
                      speed_text(p["boundary_above_rpm"], rpm, "the chart's highest"));
  if (const json& forced = p["forced_vibration"]; !forced.is_null()) text += forced_text(forced);
  if (p.contains("contact")) text += contact_text(p["contact"]);
  return text + sensitivities_text(p["sensitivities"]);
}

}  // namespace

std::string operating_points_text(const json& summary) {
  std::string text;
  for (const json& point : summary["operating_points"]) text += point_text(point);
  return text;
}

std::string lobes_report(const json& summary, const std::string& result_folder) {
  const auto title = summary["title"].get<std::string>();
  std::string text = "\n" + (title.empty() ? summary["case"].get<std::string>() : title) + "\n\n";
  for (const json& chart : summary["lobes"]) text += chart_text(chart);
  text += path_text(summary);
  if (const std::string points = operating_points_text(summary); !points.empty()) text += "\n" + points;
  for (const json& check : summary["checks"]) {
    if (!check["ok"].get<bool>())
      text += fmt::format("\n  expectation not met: {}\n", check["name"].get<std::string>());
  }
  return text + fmt::format("\n  {:.1f} s; results in {}\n", summary["timings_s"].value("total", 0.0), result_folder);
}

}  // namespace thinwall::report

#include "report/path_report.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "report/finite_number.hpp"
#include "report/lobes/lobes_words.hpp"
#include "report/robot_report.hpp"
#include "study/support/robot_survey.hpp"

namespace thinwall::report {

namespace {

PositionSummary position_summary(const setup::Setup& source, const study::PathLobes& path, std::size_t i) {
  const milling::Lobes& lobes = path.lobes[i];
  PositionSummary result;
  result.position = static_cast<int>(i) + 1;
  result.at_m = source.path->positions[i];
  result.minimum_depth_m = lobes.minimum_depth_m;
  result.at_spindle_speed_rpm = lobes.at_spindle_speed_rpm;
  result.speeds_stable_to_depth_limit = lobes.rows_at_limit;
  result.speeds_not_converged = lobes.rows_not_converged;
  result.error_estimate_relative = finite(lobes.worst_error_estimate);
  if (!path.robot.empty()) result.robot = posture_summary(path.robot[i]);
  return result;
}

/// The position with the least depth at speed number i, the first of equals.
std::size_t weakest_at(const study::PathLobes& path, std::size_t i) {
  const auto least = std::ranges::min_element(
      path.lobes, {}, [i](const milling::Lobes& lobes) { return lobes.rows[i].limiting_depth_m; });
  return static_cast<std::size_t>(least - path.lobes.begin());
}

/// The speed at which the least depth of all positions is greatest.
EverywhereSummary deepest_everywhere(const study::PathLobes& path) {
  const milling::LobeRow* best = nullptr;
  std::size_t position = 0;
  for (std::size_t i = 0; i < path.lobes.front().rows.size(); ++i) {
    const std::size_t weakest = weakest_at(path, i);
    const milling::LobeRow& row = path.lobes[weakest].rows[i];
    if (best != nullptr && row.limiting_depth_m <= best->limiting_depth_m) continue;
    best = &row;
    position = weakest;
  }
  return {best->spindle_speed_rpm, best->limiting_depth_m, best->at_limit, static_cast<int>(position) + 1};
}

/// The least depth of all positions at the case's own speed.
PathCaseSpeedSummary at_case_speed(const std::vector<milling::LobeRow>& rows) {
  const auto weakest = std::ranges::min_element(rows, {}, &milling::LobeRow::limiting_depth_m);
  const auto open =
      std::ranges::count_if(rows, [](const milling::LobeRow& row) { return !milling::answers(row.status); });
  return {.spindle_speed_rpm = weakest->spindle_speed_rpm,
          .limiting_depth_m = weakest->limiting_depth_m,
          .at_depth_limit = weakest->at_limit,
          .limited_at_position = static_cast<int>(weakest - rows.begin()) + 1,
          .error_estimate_relative = finite(weakest->error_estimate),
          .status = milling::name(weakest->status),
          .positions_not_converged = static_cast<int>(open)};
}

std::string place_text(const Eigen::Vector3d& at_m) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g}) mm", at_m.x() * 1e3, at_m.y() * 1e3, at_m.z() * 1e3);
}

std::string text_of_chart(const PathSummary& path) {
  const PositionSummary& weakest = path.weakest;
  const EverywhereSummary& deepest = path.deepest_everywhere;
  const auto& error = path.error_estimate_relative;
  const bool unlimited = weakest.speeds_stable_to_depth_limit == path.speeds;
  std::string text = fmt::format("  along the path, {}: ", chart_title(path.name));
  text += unlimited ? fmt::format("{} at every position and speed\n", depth_text(weakest.minimum_depth_m, true))
                    : fmt::format("weakest at position {} of {}, {}\n    {} at {:.0f} rpm; error {} (estimate)\n",
                                  weakest.position, path.positions.size(), place_text(weakest.at_m),
                                  depth_text(weakest.minimum_depth_m, false), weakest.at_spindle_speed_rpm,
                                  error ? fmt::format("{:.2g} %", *error * 100.0) : "unknown");
  if (!unlimited)
    text += fmt::format("    the whole path up to {} at {:.0f} rpm, limited at position {}\n",
                        depth_text(deepest.depth_m, deepest.at_depth_limit), deepest.spindle_speed_rpm,
                        deepest.limited_at_position);
  if (const auto& row = path.at_case_speed)
    text += fmt::format("    at {:.0f} rpm {}, limited at position {}\n", row->spindle_speed_rpm,
                        depth_text(row->limiting_depth_m, row->at_depth_limit), row->limited_at_position);
  if (path.rows_not_converged > 0)
    text += fmt::format("    {} rows did not reach the tolerance: see the status column of lobes/{}_path.csv\n",
                        path.rows_not_converged, core::word_of(path.name));
  return text;
}

}  // namespace

PathSummary path_summary(const setup::Setup& source, const study::PathLobes& path) {
  PathSummary result;
  result.name = path.of;
  result.method = path.lobes.front().method;
  result.support = source.path->robot_follows ? "follows" : "held";
  result.speeds = std::ssize(path.lobes.front().rows);
  double error = 0.0;
  for (std::size_t i = 0; i < path.lobes.size(); ++i) {
    result.positions.push_back(position_summary(source, path, i));
    result.rows_not_converged += path.lobes[i].rows_not_converged;
    error = std::max(error, path.lobes[i].worst_error_estimate);
  }
  result.error_estimate_relative = finite(error);
  const auto weakest = std::ranges::min_element(path.lobes, {}, &milling::Lobes::minimum_depth_m);
  result.weakest = result.positions[static_cast<std::size_t>(weakest - path.lobes.begin())];
  result.deepest_everywhere = deepest_everywhere(path);
  if (!path.at_spindle_speed.empty()) result.at_case_speed = at_case_speed(path.at_spindle_speed);
  return result;
}

std::string path_text(const Summary& summary) {
  std::string text;
  for (const PathSummary& path : summary.path) text += text_of_chart(path);
  return text;
}

}  // namespace thinwall::report

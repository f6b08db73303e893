#include "report/postures/posture_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/units.hpp"

namespace thinwall::report {

namespace {

std::string percent(double share) {
  return core::number_text(100.0 * share, 2) + " %";
}

std::string length_text(double m) {
  return core::readable_text(m, core::kind::length);
}

std::string hertz(double hz) {
  return core::number_text(hz, 4) + " Hz";
}

/// "x_mm 1700, y_mm -60"
std::string place(const std::vector<std::string>& over, const std::vector<double>& at) {
  std::string text;
  for (std::size_t c = 0; c < over.size(); ++c)
    text += (c == 0 ? "" : ", ") + over[c] + " " + core::number_text(at[c], 4);
  return text;
}

std::string mode_line(const FollowedModeSummary& mode) {
  const std::string range =
      core::number_text(mode.least_frequency_hz, 4) + " to " + core::number_text(mode.largest_frequency_hz, 4);
  std::string line = fmt::format("  {:>4}  {:>8}  {:>16}", mode.mode, mode.postures, range);
  if (mode.numbers.size() < 2) return line + "\n";
  const NumberErrorSummary &f = mode.numbers[0], &damping = mode.numbers[1];
  return line + fmt::format("  {:>8}  {:>7} at {:<10}  {:>8}  {:>7} at {:<10}  {:>5}\n", percent(f.median_error),
                            percent(f.largest_error), f.worst_posture, percent(damping.median_error),
                            percent(damping.largest_error), damping.worst_posture, percent(f.covered));
}

std::string mode_table(const LearnedRobotSummary& robot) {
  const bool errors = std::ranges::any_of(robot.modes, [](const auto& mode) { return !mode.numbers.empty(); });
  std::string text = fmt::format("  {:>4}  {:>8}  {:>16}", "mode", "postures", "Hz");
  if (errors)
    text += fmt::format("  {:<31}  {:<31}  {}", "error of frequency: median, most", "of damping", "f in 95 %");
  text += "\n";
  for (const FollowedModeSummary& mode : robot.modes) text += mode_line(mode);
  if (errors) text += "  errors are those of postures that were held out\n";
  return text;
}

std::string depth_line(const LearnedRobotSummary& robot) {
  if (!robot.depths) return "";
  const DepthErrorSummary& depth = *robot.depths;
  return fmt::format(
      "  depths    at {} rpm, postures held out: median error {}, nine in ten within {}, {} at {}; bands of 95 % hold "
      "{}\n",
      core::number_text(*robot.spindle_speed_rpm, 5), percent(depth.median_error), percent(depth.ninetieth_error),
      percent(depth.largest_error), depth.worst_posture, percent(depth.covered));
}

std::string curve_lines(const LearnedRobotSummary& robot) {
  if (!robot.curve) return "";
  std::string text = fmt::format("  learning  errors at {} postures, by the number of others that are learned from:\n",
                                 robot.curve->tested);
  const auto line = [&](const char* what, const std::vector<LearningPointSummary>& curve) {
    if (curve.empty()) return;
    text += fmt::format("            {:<9}", what);
    for (const LearningPointSummary& at : curve) {
      text += fmt::format("  {}: {} of f", at.postures, percent(at.frequency_error));
      if (at.depth_error) text += fmt::format(", {} of depth", percent(*at.depth_error));
      text += ";";
    }
    text.back() = '\n';
  };
  line("plain", robot.curve->plain);
  line("with arm", robot.curve->with_arm);
  return text;
}

std::string group_words(posture::NumberGroup group) {
  switch (group) {
    case posture::NumberGroup::frequency_and_damping:
      return "frequency and damping";
    case posture::NumberGroup::real_parts:
      return "real parts of the residue";
    case posture::NumberGroup::imaginary_parts:
      return "imaginary parts of the residue";
  }
  return "";
}

std::string sharing_lines(const LearnedRobotSummary& robot) {
  if (robot.shared.empty()) return "";
  const auto count = [&](posture::Sharing kind) {
    return std::ranges::count(robot.shared, kind, &SharedTasksSummary::sharing);
  };
  std::string text = fmt::format(
      "  together  of {} groups of numbers of a mode {} gain by learning together, {} share nothing, {} lose\n",
      robot.shared.size(), count(posture::Sharing::gains), count(posture::Sharing::none),
      count(posture::Sharing::loses));
  for (const SharedTasksSummary& tasks : robot.shared) {
    if (tasks.sharing != posture::Sharing::gains) continue;
    text += fmt::format("            mode {}, {}: R2 {} alone, {} together\n", tasks.mode, group_words(tasks.group),
                        core::number_text(tasks.R2_alone, 3), core::number_text(tasks.R2_together, 3));
  }
  return text;
}

std::string map_lines(const LearnedRobotSummary& robot) {
  if (!robot.map) return "";
  const WorkspaceMapSummary& map = *robot.map;
  std::string text = fmt::format("  map       {} places within the postures: first mode {} to {}\n", map.places,
                                 hertz(map.least_first_hz), hertz(map.largest_first_hz));
  if (!map.least_depth_m) return text;
  return text + fmt::format("            stable to {} to {}; least at {}: 95 % between {} and {}\n",
                            length_text(*map.least_depth_m), length_text(*map.largest_depth_m),
                            place(robot.over, map.least_depth_at), length_text(*map.least_depth_low_m),
                            length_text(*map.least_depth_high_m));
}

std::string envelope_line(const LearnedRobotSummary& robot) {
  if (!robot.envelope) return "";
  const EnvelopeSummary& at = *robot.envelope;
  return fmt::format(
      "  envelope  at robot.at modes below {} alone allow {} at every speed, those above {}; all together {}\n",
      hertz(at.split_hz), length_text(at.least_low_m), length_text(at.least_high_m), length_text(at.least_together_m));
}

std::string next_line(const LearnedRobotSummary& robot) {
  if (!robot.next) return "";
  return fmt::format("  next      tap at {}: it takes {} of the variance of {} along the path\n",
                     place(robot.over, robot.next->at), percent(robot.next->reduction),
                     robot.next->of_depth ? "the limiting depth" : "the frequencies");
}

}  // namespace

std::string posture_text(const LearnedRobotSummary& robot) {
  std::string text = fmt::format("  postures  {} over {}\n", robot.postures, fmt::join(robot.over, ", "));
  text += mode_table(robot) + depth_line(robot) + curve_lines(robot) + sharing_lines(robot) + map_lines(robot) +
          envelope_line(robot) + next_line(robot);
  for (const std::string& note : robot.notes) text += "  note      " + note + "\n";
  for (const std::string& doubt : robot.doubts) text += "  warning   " + doubt + "\n";
  return text;
}

}  // namespace thinwall::report

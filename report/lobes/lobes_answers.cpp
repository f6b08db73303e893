#include "report/lobes/lobes_answers.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "report/lobes/learned_summary.hpp"
#include "report/lobes/lobes_words.hpp"
#include "report/lobes/observed_summary.hpp"
#include "report/mesh_answer.hpp"

namespace thinwall::report {

namespace {

std::string sensitivity_in_words(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

/// "1 % more damping of the mode at 412.0 Hz".
std::string one_percent_more(const SensitivitySummary& entry) {
  if (!entry.mode_frequency_hz) return "1 % more " + entry.parameter;
  const std::string of_mode = fmt::format(" of the mode at {:.1f} Hz", *entry.mode_frequency_hz);
  if (entry.parameter == "frequency") return "a 1 % higher natural frequency" + of_mode;
  return (entry.parameter == "damping_ratio" ? "1 % more damping" : "1 % more compliance") + of_mode;
}

std::string robust_text(const RobustSummary& robust) {
  std::string text = fmt::format(
      "    robust        {} at {:.0f} rpm (k = {:g})\n",
      robust.minimum_depth_m > 0.0 ? fmt::format("{:.3f} mm", robust.minimum_depth_m * 1e3) : "not at any depth",
      robust.at_spindle_speed_rpm, robust.confidence);
  if (robust.speeds_not_robust > 0)
    text += fmt::format("                  not robust at any depth at {} speeds\n", robust.speeds_not_robust);
  if (robust.speeds_not_converged > 0)
    text += fmt::format("                  not converged at {} speeds\n", robust.speeds_not_converged);
  return text + pockets_text(robust.best_pockets, "pockets");
}

/// The text on the least depth's error by errors of the structure; a reduction below a thousandth is not worth a line.
void add_error_budget(std::vector<std::string>& notes, const DepthErrorsSummary& errors, double least_depth_m) {
  if (errors.truncation_m && std::abs(*errors.truncation_m) >= 1e-3 * least_depth_m) {
    notes.push_back(
        fmt::format("the part's reduction moves the least depth by {:.2g} %; more modes (reduction) lower that",
                    std::abs(*errors.truncation_m) / least_depth_m * 100.0));
  }
  if (errors.noise_deviation_m)
    notes.push_back(fmt::format("noise of measured FRFs: the least depth is known to {:.2g} % (one standard deviation)",
                                *errors.noise_deviation_m / least_depth_m * 100.0));
}

/// The text on the line between the speeds, which is told where it is not the boundary to the last digit.
void add_line(std::vector<std::string>& notes, const LineSummary& line, long speeds) {
  if (line.error_estimate_relative == 0.0) return;
  const std::string off = line.error_estimate_relative ? fmt::format("{:.2g} %", *line.error_estimate_relative * 100.0)
                                                       : "more than its points tell";
  notes.push_back(
      line.met
          ? fmt::format("between its {} speeds, {} of them added, the line is within {} of the boundary (estimate)",
                        speeds, line.speeds_added, off)
          : fmt::format("between its {} speeds, {} of them added, the line is off by {} near {:.0f} rpm (estimate); "
                        "a larger lobes.most_added brings it to {:g} %",
                        speeds, line.speeds_added, off, line.at_spindle_speed_rpm, line.tolerance * 100.0));
}

std::string indented(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += "    " + line + '\n';
  return text;
}

/// The one or two parameters that matter most.
std::vector<std::string> sensitivity_lines(const std::vector<SensitivitySummary>& sensitivities) {
  constexpr std::size_t most = 2;
  constexpr double least = 0.2;  // of the first: what matters less is not worth a line
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < std::min(most, sensitivities.size()); ++i) {
    const double value = sensitivities[i].sensitivity;
    if (std::abs(value) < least * std::abs(sensitivities[0].sensitivity)) break;
    lines.push_back(fmt::format("{} {} the limit by {:.2f} %", one_percent_more(sensitivities[i]),
                                value < 0.0 ? "lowers" : "raises", std::abs(value)));
  }
  return lines;
}

/// "With the robot: 1.4 % of …."
std::string as_sentence(const std::string& about, const std::string& line) {
  std::string text = about + ": " + line + ".";
  if (text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

}  // namespace

std::string pockets_text(const std::vector<PocketSummary>& pockets, std::string label) {
  std::string text;
  for (const PocketSummary& pocket : pockets) {
    text += fmt::format("    {:<13} {} at {:.0f} rpm", std::exchange(label, ""),
                        depth_text(pocket.depth_m, pocket.at_depth_limit), pocket.spindle_speed_rpm);
    if (pocket.removal_rate_cm3_per_min) text += fmt::format(", {:.3g} cm3/min", *pocket.removal_rate_cm3_per_min);
    text += fmt::format(", limited by {}, nine tenths at {}{}\n", sensitivity_in_words(pocket.limited_by),
                        width_text(pocket), pocket.at_chart_edge ? "; edge of the chart" : "");
  }
  return text;
}

std::string sensitivities_text(const std::vector<SensitivitySummary>& sensitivities) {
  return indented(sensitivity_lines(sensitivities));
}

std::vector<std::string> chart_notes(const LobesSummary& chart) {
  std::vector<std::string> notes;
  if (chart.error_budget && chart.error_budget->at_minimum)
    add_error_budget(notes, *chart.error_budget->at_minimum, chart.minimum_depth_m);
  if (chart.line) add_line(notes, *chart.line, chart.speeds);
  for (const ComparedSummary& other : chart.compared) {
    notes.push_back(fmt::format("{}: differs by up to {:.2g} % (at {:.0f} rpm)", sensitivity_in_words(other.name),
                                other.largest_relative_difference * 100.0, other.at_spindle_speed_rpm));
  }
  if (chart.map && chart.map->speeds_not_converged > 0) {
    notes.push_back(fmt::format("{} of {} speeds of the map did not reach the tolerance",
                                chart.map->speeds_not_converged, chart.map->speeds));
  }
  if (chart.static_share.value_or(0.0) > 0.01) {
    notes.push_back(fmt::format(
        "{:.1f} % of the static compliance lies in modes above {}, taken without their dynamics",
        *chart.static_share * 100.0,
        chart.modes_up_to_hz ? fmt::format("{:.4g} kHz", *chart.modes_up_to_hz * 1e-3) : "those that are known"));
  }
  if (chart.speeds_not_converged > 0) {
    notes.push_back(fmt::format("{} of {} speeds did not reach the tolerance: see the status column of lobes/{}.csv",
                                chart.speeds_not_converged, chart.speeds, core::word_of(chart.name)));
  }
  return notes;
}

std::string asked_text(const LobesSummary& chart) {
  return (chart.robust ? robust_text(*chart.robust) : "") + indented(chart_notes(chart)) +
         (chart.observed ? observed_text(*chart.observed) : "") + (chart.learned ? learned_text(*chart.learned) : "");
}

std::vector<std::string> sensitivity_sentences(const LobesSummary& chart) {
  std::vector<std::string> list;
  if (!chart.at_case_speed) return list;
  for (const std::string& line : sensitivity_lines(chart.at_case_speed->sensitivities))
    list.push_back(as_sentence(chart_title(chart.name), line));
  return list;
}

std::vector<std::string> answer_sentences(const Summary& summary) {
  std::vector<std::string> list;
  if (const std::string text = tolerance_not_met(summary); !text.empty()) list.push_back(as_sentence("the mesh", text));
  for (const LobesSummary& chart : summary.lobes) {
    std::ranges::move(sensitivity_sentences(chart), std::back_inserter(list));
    for (const std::string& line : chart_notes(chart)) list.push_back(as_sentence(chart_title(chart.name), line));
  }
  for (const PathSummary& path : summary.path) {
    if (path.rows_not_converged == 0) continue;
    list.push_back(
        as_sentence("along the path, " + chart_title(path.name),
                    fmt::format("{} rows did not reach the tolerance: see the status column of lobes/{}_path.csv",
                                path.rows_not_converged, core::word_of(path.name))));
  }
  return list;
}

}  // namespace thinwall::report

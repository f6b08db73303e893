#include "report/lobes_answers.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "report/lobes_words.hpp"

namespace thinwall::report {

using nlohmann::json;

namespace {

std::string sensitivity_in_words(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

/// "1 % more damping of the mode at 412.0 Hz".
std::string one_percent_more(const json& entry) {
  const auto parameter = entry["parameter"].get<std::string>();
  if (entry["mode_frequency_hz"].is_null()) return "1 % more " + parameter;
  const std::string of_mode = fmt::format(" of the mode at {:.1f} Hz", entry["mode_frequency_hz"].get<double>());
  if (parameter == "frequency") return "a 1 % higher natural frequency" + of_mode;
  return (parameter == "damping_ratio" ? "1 % more damping" : "1 % more compliance") + of_mode;
}

std::string depth_text(const json& pocket) {
  return fmt::format("{}{:.3f} mm", pocket["at_depth_limit"].get<bool>() ? "over " : "",
                     pocket["depth_m"].get<double>() * 1e3);
}

std::string robust_text(const json& robust) {
  const double depth_mm = robust["minimum_depth_m"].get<double>() * 1e3;
  std::string text = fmt::format("    robust        {} at {:.0f} rpm (k = {:g})\n",
                                 depth_mm > 0.0 ? fmt::format("{:.3f} mm", depth_mm) : "not at any depth",
                                 robust["at_spindle_speed_rpm"].get<double>(), robust["confidence"].get<double>());
  if (const int missed = robust["speeds_not_robust"].get<int>(); missed > 0)
    text += fmt::format("                  not robust at any depth at {} speeds\n", missed);
  if (const int open = robust["speeds_not_converged"].get<int>(); open > 0)
    text += fmt::format("                  not converged at {} speeds\n", open);
  return text + pockets_text(robust["best_pockets"], "pockets");
}

/// The text on the least depth's error by errors of the structure; a reduction below a thousandth is not worth a line.
void add_error_budget(std::vector<std::string>& notes, const json& budget, double least_depth_m) {
  if (!budget.contains("at_minimum")) return;
  const json &reduction = budget["at_minimum"]["truncation_m"], &noise = budget["at_minimum"]["noise_deviation_m"];
  if (!reduction.is_null() && std::abs(reduction.get<double>()) >= 1e-3 * least_depth_m) {
    notes.push_back(
        fmt::format("the part's reduction moves the least depth by {:.2g} %; more modes (reduction) lower that",
                    std::abs(reduction.get<double>()) / least_depth_m * 100.0));
  }
  if (!noise.is_null())
    notes.push_back(fmt::format("noise of measured FRFs: the least depth is known to {:.2g} % (one standard deviation)",
                                noise.get<double>() / least_depth_m * 100.0));
}

std::string indented(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += "    " + line + '\n';
  return text;
}

/// The one or two parameters that matter most.
std::vector<std::string> sensitivity_lines(const json& sensitivities) {
  constexpr std::size_t most = 2;
  constexpr double least = 0.2;  // of the first: what matters less is not worth a line
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < std::min(most, sensitivities.size()); ++i) {
    const double value = sensitivities[i]["sensitivity"].get<double>();
    if (std::abs(value) < least * std::abs(sensitivities[0]["sensitivity"].get<double>())) break;
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

std::string pockets_text(const json& pockets, std::string label) {
  std::string text;
  for (const json& pocket : pockets) {
    text += fmt::format("    {:<13} {} at {:.0f} rpm", std::exchange(label, ""), depth_text(pocket),
                        pocket["spindle_speed_rpm"].get<double>());
    if (!pocket["removal_rate_cm3_per_min"].is_null())
      text += fmt::format(", {:.3g} cm3/min", pocket["removal_rate_cm3_per_min"].get<double>());
    text += fmt::format(", limited by {}\n", sensitivity_in_words(pocket["limited_by"].get<std::string>()));
  }
  return text;
}

std::string sensitivities_text(const json& sensitivities) {
  return indented(sensitivity_lines(sensitivities));
}

std::vector<std::string> chart_notes(const json& chart) {
  std::vector<std::string> notes;
  if (!chart["error_budget"].is_null())
    add_error_budget(notes, chart["error_budget"], chart["minimum_depth_m"].get<double>());
  if (chart.contains("compared")) {
    for (const json& other : chart["compared"]) {
      notes.push_back(fmt::format("{}: differs by up to {:.2g} % (at {:.0f} rpm)", sensitivity_in_words(other["name"]),
                                  other["largest_relative_difference"].get<double>() * 100.0,
                                  other["at_spindle_speed_rpm"].get<double>()));
    }
  }
  if (chart.contains("map") && chart["map"]["speeds_not_converged"].get<int>() > 0) {
    notes.push_back(fmt::format("{} of {} speeds of the map did not reach the tolerance",
                                chart["map"]["speeds_not_converged"].get<int>(), chart["map"]["speeds"].get<int>()));
  }
  if (const json& share = chart["static_share"]; !share.is_null() && share.get<double>() > 0.01) {
    notes.push_back(fmt::format(
        "{:.1f} % of the static compliance lies in modes above lobes.modes_up_to, taken without their dynamics",
        share.get<double>() * 100.0));
  }
  if (const int missed = chart["speeds_not_converged"].get<int>(); missed > 0) {
    notes.push_back(fmt::format("{} of {} speeds did not reach the tolerance: see the status column of lobes/{}.csv",
                                missed, chart["speeds"].get<int>(), chart["name"].get<std::string>()));
  }
  return notes;
}

std::string asked_text(const json& chart) {
  return (chart.contains("robust") ? robust_text(chart["robust"]) : "") + indented(chart_notes(chart));
}

std::vector<std::string> answer_sentences(const json& summary) {
  std::vector<std::string> list;
  for (const json& chart : summary["lobes"]) {
    const std::string title = chart_title(chart["name"].get<std::string>());
    if (chart.contains("at_case_speed")) {
      for (const std::string& line : sensitivity_lines(chart["at_case_speed"]["sensitivities"]))
        list.push_back(as_sentence(title, line));
    }
    for (const std::string& line : chart_notes(chart)) list.push_back(as_sentence(title, line));
  }
  if (!summary.contains("path")) return list;
  for (const json& path : summary["path"]) {
    if (const int missed = path["rows_not_converged"].get<int>(); missed > 0) {
      list.push_back(as_sentence("along the path, " + chart_title(path["name"].get<std::string>()),
                                 fmt::format("{} rows did not reach the tolerance: see the status column of "
                                             "lobes/{}_path.csv",
                                             missed, path["name"].get<std::string>())));
    }
  }
  return list;
}

}  // namespace thinwall::report

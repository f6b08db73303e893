#include "app/lobes_answers.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace thinwall::app {

using nlohmann::json;

namespace {

std::string in_words(std::string name) {
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

/// What errors of the structure make of the least depth; a reduction below a thousandth is not worth a line.
std::string error_budget_text(const json& budget, double least_depth_m) {
  std::string text;
  if (!budget.contains("at_minimum")) return text;
  const json &reduction = budget["at_minimum"]["truncation_m"], &noise = budget["at_minimum"]["noise_deviation_m"];
  if (!reduction.is_null() && std::abs(reduction.get<double>()) >= 1e-3 * least_depth_m) {
    text +=
        fmt::format("    the part's reduction moves the least depth by {:.2g} %; more modes (reduction) lower that\n",
                    std::abs(reduction.get<double>()) / least_depth_m * 100.0);
  }
  if (!noise.is_null())
    text += fmt::format("    noise of measured FRFs: the least depth is known to {:.2g} % (one standard deviation)\n",
                        noise.get<double>() / least_depth_m * 100.0);
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
    text += fmt::format(", limited by {}\n", in_words(pocket["limited_by"].get<std::string>()));
  }
  return text;
}

std::string sensitivities_text(const json& sensitivities) {
  constexpr std::size_t most = 2;
  constexpr double least = 0.2;  // of the first: what matters less is not worth a line
  std::string text;
  for (std::size_t i = 0; i < std::min(most, sensitivities.size()); ++i) {
    const double value = sensitivities[i]["sensitivity"].get<double>();
    if (std::abs(value) < least * std::abs(sensitivities[0]["sensitivity"].get<double>())) break;
    text += fmt::format("    {} {} the limit by {:.2f} %\n", one_percent_more(sensitivities[i]),
                        value < 0.0 ? "lowers" : "raises", std::abs(value));
  }
  return text;
}

std::string asked_text(const json& chart) {
  std::string text;
  if (!chart["error_budget"].is_null())
    text += error_budget_text(chart["error_budget"], chart["minimum_depth_m"].get<double>());
  if (chart.contains("robust")) text += robust_text(chart["robust"]);
  if (chart.contains("compared")) {
    for (const json& other : chart["compared"]) {
      text += fmt::format("    {}: differs by up to {:.2g} % (at {:.0f} rpm)\n", in_words(other["name"]),
                          other["largest_relative_difference"].get<double>() * 100.0,
                          other["at_spindle_speed_rpm"].get<double>());
    }
  }
  if (chart.contains("map") && chart["map"]["speeds_not_converged"].get<int>() > 0) {
    text += fmt::format("    {} of {} speeds of the map did not reach the tolerance\n",
                        chart["map"]["speeds_not_converged"].get<int>(), chart["map"]["speeds"].get<int>());
  }
  return text;
}

}  // namespace thinwall::app

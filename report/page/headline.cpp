#include "report/page/headline.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "report/json_number.hpp"
#include "report/page/limit_text.hpp"

namespace thinwall::report {

namespace {

using nlohmann::json;

/// A chart or a path with its limit; the first of a run is the one that answers.
struct Answer {
  const json* chart;
  Limit limit;
};

/// The supported part before the bare one.
std::vector<Answer> answers(const json& charts, const json& cutting, Limit (*limit_of)(const json&, const json&)) {
  std::vector<Answer> list;
  for (const json& chart : charts) {
    const bool first = chart.at("name") == "supported";
    list.insert(first ? list.begin() : list.end(), {&chart, limit_of(chart, cutting)});
  }
  return list;
}

/// "P", "B and C": the points of the part that contacts hold.
std::string held_points(const json& summary) {
  std::vector<std::string> names;
  for (const json& contact : summary.value("contacts", json::array())) {
    const auto name = contact.at("part").get<std::string>();
    if (std::ranges::count(names, name) == 0) names.push_back(name);
  }
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 < names.size() ? ", " : " and ") + names[i];
  return text;
}

/// "with the robot at P", "with the robot at B, cut at P", "part alone, cut at P", "this tool".
std::string subject(const json& chart, const json& summary) {
  const auto name = chart.at("name").get<std::string>();
  if (name == "tool") return "this tool";
  const std::string at = summary.value("cutting", json::object()).value("at", "");
  const std::string cut = at.empty() ? "" : ", cut at " + at;
  if (name != "supported") return "part alone" + cut;
  const std::string held = held_points(summary);
  return "with the robot" + (held.empty() ? "" : " at " + held) + (held == at ? "" : cut);
}

std::string path_subject(const json& path) {
  return path.at("name") == "supported" ? "along the path with the robot" : "along the path, part alone";
}

/// Both limits in one sentence.
std::string sentence(const std::string& subject, const std::vector<Answer>& list) {
  std::string text = subject + ": " + text_of(list.front().limit);
  if (list.size() > 1) text += "; without: " + short_text_of(list[1].limit);
  return capital(text) + ".";
}

std::string pocket_text(const json& chart) {
  const json pockets = chart.value("best_pockets", json::array());
  if (pockets.empty()) return "";
  const json& pocket = pockets.front();
  std::string text = fmt::format("best pocket {} at {:.0f} rpm", millimetres(pocket.at("depth_m").get<double>()),
                                 pocket.at("spindle_speed_rpm").get<double>());
  if (pocket.contains("limited_by") && pocket.at("limited_by").is_string())
    text += " (" + in_words(pocket.at("limited_by").get<std::string>()) + ")";
  if (const auto rate = number(pocket, "removal_rate_cm3_per_min")) text += fmt::format(", {:.3g} cm³/min", *rate);
  return text;
}

/// The speed at which the whole path allows the most.
std::string best_speed_text(const json& path, const json& cutting) {
  const json& best = path.at("deepest_everywhere");
  const bool limit = best.at("at_depth_limit").get<bool>();
  return fmt::format("best for the whole path {} at {:.0f} rpm ({})", millimetres(best.at("depth_m").get<double>()),
                     best.at("spindle_speed_rpm").get<double>(),
                     limit ? in_words(cutting.value("depth_limit_is", "depth_limit"))
                           : fmt::format("limited at position {}", best.at("limited_at_position").get<int>()));
}

/// "1900 rpm and 2 mm".
std::string place_text(const json& point) {
  return fmt::format("{:.0f} rpm and {}", point.at("spindle_speed_rpm").get<double>(),
                     millimetres(point.at("depth_m").get<double>()));
}

/// "at least 18 mm"; of an unstable point how much less would be stable.
std::string margin_text(const json& point) {
  const double margin = point.at("depth_margin_m").get<double>();
  const bool stable = point.at("stable").get<bool>();
  const bool at_limit = stable && point.at("depth_margin_at_limit").get<bool>();
  return (at_limit ? "at least " : "") + millimetres(stable ? margin : std::abs(margin)) + (stable ? "" : " too deep");
}

/// The first operating point of the chart that answers.
std::string margin_of(const json& summary, const json& chart) {
  for (const json& point : summary.value("operating_points", json::array())) {
    if (point.at("chart") != chart.at("name")) continue;
    return "margin at " + place_text(point) + ": " +
           (!is_sound(point)                  ? "not converged"
            : number(point, "depth_margin_m") ? margin_text(point)
                                              : "not known");
  }
  return "";
}

/// One figure for all depths of the sentence: the largest that is known of them.
std::string error_text(const std::vector<Answer>& list) {
  double worst = 0.0;
  bool limited = false;
  for (const Answer& answer : list) {
    if (!answer.limit.of_depth_limit.empty()) continue;
    limited = true;
    worst = std::max(worst, depth_error(answer.chart->value("at_case_speed", *answer.chart), *answer.chart));
  }
  if (!limited) worst = depth_error(*list.front().chart, *list.front().chart);
  if (worst <= 0.0) return "";
  return worst < 1e-4 ? "estimated error below 0.01 %" : fmt::format("estimated error {:.2g} %", 100.0 * worst);
}

/// Of a run without lobes: what the support does, or the modes.
std::vector<std::string> dynamics(const json& summary) {
  std::vector<std::string> list;
  for (const json& r : summary.value("coupling", json::object()).value("reductions", json::array())) {
    list.push_back(fmt::format("Vibration at {} falls by {:.4g} % at {:.4g} Hz with the robot.",
                               r.at("dof").get<std::string>(), 100.0 * r.at("reduction").get<double>(),
                               r.at("frequency_hz").get<double>()));
  }
  for (const char* name : {"part", "robot"}) {
    if (!list.empty() || !summary.contains(name) || !summary[name].contains("modes")) continue;
    std::string frequencies;
    int shown = 0;
    for (const json& mode : summary[name].at("modes")) {
      if (mode.contains("rigid_body") || shown == 4) continue;
      frequencies += fmt::format("{}{:.4g}", shown++ == 0 ? "" : ", ", mode.at("frequency_hz").get<double>());
    }
    if (shown > 0) list.push_back(fmt::format("First natural frequencies of the {}: {} Hz.", name, frequencies));
  }
  return list;
}

std::string point_sentence(const json& point) {
  const auto chart = point.at("chart").get<std::string>();
  std::string text = (chart == "supported" ? "With the robot, "
                      : chart == "part"    ? "Part alone, "
                                           : "This tool, ") +
                     place_text(point) + ": ";
  if (!is_sound(point)) text += "not converged: ";
  text += point.at("stable").get<bool>() ? "stable" : "chatter";
  if (number(point, "depth_margin_m"))
    text += point.at("stable").get<bool>() ? ", margin in depth " + margin_text(point) : ", " + margin_text(point);
  if (point.contains("contact") && point.at("contact").at("lost").get<bool>())
    text += "; the cut pulls the contact open";
  return text + ".";
}

std::string routes_sentence(const json& summary) {
  const json routes = summary.value("coupling", json::object()).value("route_difference", json(nullptr));
  const auto difference = routes.is_object() ? number(routes, "max_relative") : std::nullopt;
  return !difference ? "" : fmt::format("The two routes to the coupled receptance differ by {:.1e}.", *difference);
}

}  // namespace

double depth_error(const json& row, const json& chart) {
  const bool at_speed = row.contains("limiting_depth_m");
  const double depth = row.value(at_speed ? "limiting_depth_m" : "minimum_depth_m", 0.0);
  const json of_chart = chart.value("error_budget", json(nullptr));
  const json of_row = at_speed ? row.value("error_budget", json(nullptr))
                      : of_chart.is_object() && of_chart.contains("at_minimum") ? of_chart.at("at_minimum")
                                                                                : json(nullptr);
  const auto share = [&](const char* key, const char* largest) {
    const auto here = of_row.is_object() ? number(of_row, key) : std::nullopt;
    if (here && depth > 0.0) return std::abs(*here) / depth;
    return of_chart.is_object() ? number(of_chart, largest).value_or(0.0) : 0.0;
  };
  return number(row, "error_estimate_relative").value_or(0.0) + share("truncation_m", "largest_truncation_relative") +
         2.0 * share("noise_deviation_m", "largest_noise_relative");
}

std::vector<std::string> headline(const json& summary) {
  if (summary.at("lobes").empty()) return dynamics(summary);
  const json cutting = summary.value("cutting", json::object());
  const bool path = summary.contains("path") && !summary.at("path").empty();
  const auto list = path ? answers(summary.at("path"), cutting, limit_of_path)
                         : answers(summary.at("lobes"), cutting, limit_of_chart);
  const json& chart = *list.front().chart;
  std::string second;
  for (const std::string& text : {path ? best_speed_text(chart, cutting) : pocket_text(chart),
                                  path ? "" : margin_of(summary, chart), error_text(list)}) {
    if (!text.empty()) second += (second.empty() ? "" : "; ") + text;
  }
  std::vector<std::string> sentences{sentence(path ? path_subject(chart) : subject(chart, summary), list)};
  if (!second.empty()) sentences.push_back(capital(second) + ".");
  return sentences;
}

std::vector<std::string> sentences(const json& summary) {
  std::vector<std::string> list;
  if (summary.contains("path") && !summary.at("path").empty() && !summary.at("lobes").empty()) {
    const json cutting = summary.value("cutting", json::object());
    const auto charts = answers(summary.at("lobes"), cutting, limit_of_chart);
    list.push_back(sentence(subject(*charts.front().chart, summary), charts));
  }
  for (const json& point : summary.value("operating_points", json::array())) list.push_back(point_sentence(point));
  for (const json& sentence : summary.value("sentences", json::array())) list.push_back(sentence.get<std::string>());
  if (const std::string routes = routes_sentence(summary); !routes.empty()) list.push_back(routes);
  return list;
}

}  // namespace thinwall::report

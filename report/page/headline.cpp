#include "report/page/headline.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "report/lobes/lobes_answers.hpp"
#include "report/lobes/lobes_words.hpp"
#include "report/page/limit_text.hpp"

namespace thinwall::report {

namespace {

/// A chart or a path by its limit; the first of a run is the one that answers.
struct Answer {
  std::size_t number = 0;  ///< in the summary
  Limit limit;
  double error = 0.0, error_of_least = 0.0;  ///< relative, of that limit and of the least depth anywhere
};

/// The relative error that a depth may have: the estimate of the computation, what the part's reduction left out, and
/// twice the standard deviation by the noise of measured FRFs, as the chart's band has them, and the range by what was
/// identified. Where the row does not
/// tell, the chart's largest. 0: nothing is known.
double depth_error(double depth_m, const std::optional<double>& estimate, const DepthErrorsSummary* of_row,
                   const std::optional<ChartErrorsSummary>& of_chart) {
  const auto share = [&](const std::optional<double>& here, const std::optional<double>& largest) {
    return here && depth_m > 0.0 ? std::abs(*here) / depth_m : largest.value_or(0.0);
  };
  const DepthErrorsSummary row = of_row != nullptr ? *of_row : DepthErrorsSummary{};
  const ChartErrorsSummary chart = of_chart.value_or(ChartErrorsSummary{});
  double identification = chart.largest_identification_relative.value_or(0.0);
  if (row.identification && depth_m > 0.0)
    identification = std::max(1.0 - row.identification->low_m / depth_m, row.identification->high_m / depth_m - 1.0);
  return estimate.value_or(0.0) + share(row.truncation_m, chart.largest_truncation_relative) +
         2.0 * share(row.noise_deviation_m, chart.largest_noise_relative) + identification;
}

double error_of_least(const LobesSummary& chart) {
  const bool known = chart.error_budget && chart.error_budget->at_minimum;
  return depth_error(chart.minimum_depth_m, chart.error_estimate_relative,
                     known ? &*chart.error_budget->at_minimum : nullptr, chart.error_budget);
}

double error_at_speed(const LobesSummary& chart) {
  const auto& row = chart.at_case_speed;
  if (!row) return error_of_least(chart);
  return depth_error(row->limiting_depth_m, row->error_estimate_relative,
                     row->error_budget ? &*row->error_budget : nullptr, chart.error_budget);
}

bool with_robot(study::ChartOf name) {
  return name == study::ChartOf::supported || name == study::ChartOf::carried;
}

/// The chart with the robot before that of the part alone.
void add(std::vector<Answer>& list, study::ChartOf name, Answer answer) {
  list.insert(with_robot(name) ? list.begin() : list.end(), std::move(answer));
}

std::vector<Answer> chart_answers(const Summary& summary) {
  std::vector<Answer> list;
  for (std::size_t i = 0; i < summary.lobes.size(); ++i) {
    const LobesSummary& chart = summary.lobes[i];
    add(list, chart.name, {i, limit_of_chart(chart, summary.cutting), error_at_speed(chart), error_of_least(chart)});
  }
  return list;
}

std::vector<Answer> path_answers(const Summary& summary) {
  std::vector<Answer> list;
  for (std::size_t i = 0; i < summary.path.size(); ++i) {
    const PathSummary& path = summary.path[i];
    const double least = path.error_estimate_relative.value_or(0.0);
    const double error = path.at_case_speed ? path.at_case_speed->error_estimate_relative.value_or(0.0) : least;
    add(list, path.name, {i, limit_of_path(path, summary.cutting), error, least});
  }
  return list;
}

/// "P", "B and C": the points of the part that contacts hold.
std::string held_points(const Summary& summary) {
  std::vector<std::string> names;
  for (const ContactSummary& contact : summary.contacts) {
    if (std::ranges::count(names, contact.part) == 0) names.push_back(contact.part);
  }
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 < names.size() ? ", " : " and ") + names[i];
  return text;
}

/// "with the robot at P", "with the robot at B, cut at P", "part alone, cut at P", "this tool", "tool on robot".
std::string subject(const LobesSummary& chart, const Summary& summary) {
  if (chart.name == study::ChartOf::tool) return "this tool";
  const std::string at = summary.cutting ? summary.cutting->at.value_or("") : "";
  const std::string cut = at.empty() ? "" : ", cut at " + at;
  if (chart.name != study::ChartOf::supported) return chart_title(chart.name) + cut;
  const std::string held = held_points(summary);
  return "with the robot" + (held.empty() ? "" : " at " + held) + (held == at ? "" : cut);
}

std::string path_subject(const PathSummary& path) {
  if (path.name == study::ChartOf::supported) return "along the path with the robot";
  return "along the path, " + chart_title(path.name);
}

/// Both limits in one sentence.
std::string sentence(const std::string& subject, const std::vector<Answer>& list) {
  std::string text = subject + ": " + text_of(list.front().limit);
  if (list.size() > 1) text += "; without: " + short_text_of(list[1].limit);
  return capital(text) + ".";
}

std::string pocket_text(const LobesSummary& chart) {
  if (!chart.best_pocket) return "";
  const PocketSummary& pocket = *chart.best_pocket;
  std::string text = fmt::format("{} {} at {:.0f} rpm", best_pocket_title(chart), millimetres(pocket.depth_m),
                                 pocket.spindle_speed_rpm);
  if (!pocket.limited_by.empty()) text += " (" + in_words(pocket.limited_by) + ")";
  text += ", nine tenths of it at " + width_text(pocket);
  if (pocket.removal_rate_cm3_per_min) text += fmt::format(", {:.3g} cm³/min", *pocket.removal_rate_cm3_per_min);
  return text;
}

std::string doubt_text(const LobesSummary& chart) {
  if (!chart.below_first_resonance) return "";
  return fmt::format(
      "To be doubted: the limit hangs on measured lines below the first resonance (chatter at {:.4g} Hz, first "
      "resonance at {:.4g} Hz).",
      chart.below_first_resonance->chatter_frequency_hz, chart.below_first_resonance->first_resonance_hz);
}

/// The speed at which the whole path allows the most.
std::string best_speed_text(const PathSummary& path, const std::optional<CuttingSummary>& cutting) {
  const EverywhereSummary& best = path.deepest_everywhere;
  return fmt::format("best for the whole path {} at {:.0f} rpm ({})", millimetres(best.depth_m), best.spindle_speed_rpm,
                     best.at_depth_limit ? in_words(cutting ? cutting->depth_limit_is : "depth_limit")
                                         : fmt::format("limited at position {}", best.limited_at_position));
}

/// "1900 rpm and 2 mm".
std::string place_text(const OperatingPointSummary& point) {
  return fmt::format("{:.0f} rpm and {}", point.spindle_speed_rpm, millimetres(point.depth_m));
}

/// "at least 18 mm"; of an unstable point how much less would be stable.
std::string margin_text(const OperatingPointSummary& point) {
  const double margin = point.depth_margin_m;
  if (!point.stable) return millimetres(std::abs(margin)) + " too deep";
  return (point.depth_margin_at_limit ? "at least " : "") + millimetres(margin);
}

/// The first operating point of the chart that answers.
std::string margin_of(const Summary& summary, const LobesSummary& chart) {
  const auto point = std::ranges::find(summary.operating_points, chart.name, &OperatingPointSummary::chart);
  if (point == summary.operating_points.end()) return "";
  return "margin at " + place_text(*point) + ": " +
         (!is_sound(point->status)               ? "not converged"
          : std::isfinite(point->depth_margin_m) ? margin_text(*point)
                                                 : "not known");
}

/// One figure for all depths of the sentence: the largest that is known of them.
std::string error_text(const std::vector<Answer>& list) {
  double worst = 0.0;
  bool limited = false;
  for (const Answer& answer : list) {
    if (!answer.limit.of_depth_limit.empty()) continue;
    limited = true;
    worst = std::max(worst, answer.error);
  }
  if (!limited) worst = list.front().error_of_least;
  if (worst <= 0.0) return "";
  return worst < 1e-4 ? "estimated error below 0.01 %" : fmt::format("estimated error {:.2g} %", 100.0 * worst);
}

/// "First natural frequencies of the part: 212.9, 562.8 Hz."; empty if there are none.
std::string frequencies_sentence(const char* name, std::vector<double> elastic_hz) {
  constexpr std::size_t most = 4;
  elastic_hz.resize(std::min(most, elastic_hz.size()));
  if (elastic_hz.empty()) return "";
  std::string frequencies;
  for (const double hz : elastic_hz) frequencies += fmt::format("{}{:.4g}", frequencies.empty() ? "" : ", ", hz);
  return fmt::format("First natural frequencies of the {}: {} Hz.", name, frequencies);
}

/// The answer of a run without lobes: what the support does, or the modes.
std::vector<std::string> dynamics(const Summary& summary) {
  std::vector<std::string> list;
  if (summary.coupling) {
    for (const AmplitudeReductionSummary& r : summary.coupling->reductions)
      list.push_back(fmt::format("Vibration at {} falls by {:.4g} % at {:.4g} Hz with the robot.", r.dof,
                                 100.0 * r.reduction, r.frequency_hz));
  }
  if (!list.empty()) return list;
  std::vector<double> part_hz, robot_hz;
  if (summary.part) {
    for (const PartModeSummary& mode : summary.part->modes) {
      if (!mode.rigid_body) part_hz.push_back(mode.frequency_hz);
    }
  }
  if (summary.robot) {
    for (const ModeSummary& mode : summary.robot->modes) robot_hz.push_back(mode.frequency_hz);
  }
  const std::string of_part = frequencies_sentence("part", part_hz);
  const std::string text = of_part.empty() ? frequencies_sentence("robot", robot_hz) : of_part;
  if (!text.empty()) list.push_back(text);
  return list;
}

std::string point_sentence(const OperatingPointSummary& point) {
  std::string text = (point.chart == study::ChartOf::tool ? "This tool" : capital(chart_title(point.chart))) + ", " +
                     place_text(point) + ": ";
  if (!is_sound(point.status)) text += "not converged: ";
  text += point.stable ? "stable" : "chatter";
  if (std::isfinite(point.depth_margin_m)) text += (point.stable ? ", margin in depth " : ", ") + margin_text(point);
  if (point.contact && point.contact->lost) text += "; the cut pulls the contact open";
  return text + ".";
}

/// The run's own sentences but those on sensitivities, of which the page has a table.
std::vector<std::string> remarks(const Summary& summary) {
  std::vector<std::string> list = summary.sentences;
  for (const LobesSummary& chart : summary.lobes) {
    for (const std::string& sentence : sensitivity_sentences(chart)) std::erase(list, sentence);
  }
  return list;
}

}  // namespace

std::vector<std::string> headline(const Summary& summary) {
  if (summary.lobes.empty()) return dynamics(summary);
  const bool path = !summary.path.empty();
  const std::vector<Answer> list = path ? path_answers(summary) : chart_answers(summary);
  const std::size_t first = list.front().number;
  std::string second;
  for (const std::string& text :
       {path ? best_speed_text(summary.path[first], summary.cutting) : pocket_text(summary.lobes[first]),
        path ? "" : margin_of(summary, summary.lobes[first]), error_text(list)}) {
    if (!text.empty()) second += (second.empty() ? "" : "; ") + text;
  }
  std::vector<std::string> sentences{
      sentence(path ? path_subject(summary.path[first]) : subject(summary.lobes[first], summary), list)};
  if (!second.empty()) sentences.push_back(capital(second) + ".");
  if (const std::string doubt = path ? "" : doubt_text(summary.lobes[first]); !doubt.empty())
    sentences.insert(sentences.begin() + 1, doubt);
  return sentences;
}

std::vector<std::string> sentences(const Summary& summary) {
  std::vector<std::string> list;
  if (!summary.path.empty() && !summary.lobes.empty()) {
    const std::vector<Answer> charts = chart_answers(summary);
    list.push_back(sentence(subject(summary.lobes[charts.front().number], summary), charts));
  }
  for (const OperatingPointSummary& point : summary.operating_points) list.push_back(point_sentence(point));
  std::ranges::move(remarks(summary), std::back_inserter(list));
  return list;
}

}  // namespace thinwall::report

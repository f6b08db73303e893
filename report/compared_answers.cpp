#include "report/compared_answers.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/units.hpp"
#include "io/json_file.hpp"
#include "report/page/headline.hpp"
#include "report/summary/summary_json.hpp"
#include "report/summary/summary_schema.hpp"

namespace thinwall::report {

namespace {

/// Figures of the summary by what hangs on them, the weightiest first; * stands for any index.
constexpr std::array weighty{"path[*].at_case_speed.limiting_depth_m",
                             "path[*].deepest_everywhere.depth_m",
                             "lobes[*].at_case_speed.limiting_depth_m",
                             "lobes[*].minimum_depth_m",
                             "lobes[*].best_pockets[0].depth_m",
                             "lobes[*].best_pockets[0].spindle_speed_rpm",
                             "operating_points[*].stable",
                             "operating_points[*].depth_margin_m",
                             "simulation.points[*].motion",
                             "simulation.points[*].growth.lobes_modulus",
                             "lobes[*].robust.minimum_depth_m",
                             "lobes[*].at_case_speed.chatter_frequency_hz",
                             "coupling.reductions[*].reduction",
                             "coupling.modes[*].frequency_hz",
                             "coupling.modes[*].damping_ratio",
                             "part.modes[*].frequency_hz",
                             "robot.modes[*].frequency_hz",
                             "part.modes[*].damping_ratio",
                             "updating[*].parameters[*].fitted"};
constexpr std::size_t most_figures = 10;

/// True if the path is the pattern with numbers in place of every *.
bool fits(std::string_view path, std::string_view pattern) {
  while (!pattern.empty()) {
    if (pattern.front() == '*') {
      const auto end = std::min(path.find_first_not_of("0123456789"), path.size());
      if (end == 0) return false;
      path.remove_prefix(end);
    } else if (!path.empty() && path.front() == pattern.front()) {
      path.remove_prefix(1);
    } else {
      return false;
    }
    pattern.remove_prefix(1);
  }
  return path.empty();
}

/// "1.72 mm", "14000 rpm".
std::string value_text(double value, Kind kind) {
  if (kind == Kind::spindle_speed) return fmt::format("{:.0f} rpm", value);
  return core::readable_text(value, {"", unit_of(kind), ""});
}

/// Both values, to ten digits where fewer do not show the difference.
std::pair<std::string, std::string> values_of(const Difference& difference) {
  if (!difference.numbers) return {difference.left, difference.right};
  const Kind kind = kind_at(difference.path);
  std::pair texts(value_text(difference.numbers->first, kind), value_text(difference.numbers->second, kind));
  if (texts.first != texts.second) return texts;
  const std::string unit = unit_of(kind).empty() ? "" : " " + std::string(unit_of(kind));
  return {difference.left + unit, difference.right + unit};
}

std::string change_of(const Difference& difference) {
  if (!difference.numbers) return "";
  const auto [a, b] = *difference.numbers;
  const double change = (b - a) / std::abs(a);
  return std::isfinite(change) ? fmt::format("{:+.3g} %", 100.0 * change) : "";
}

std::string row(const Difference& difference) {
  const auto [left, right] = values_of(difference);
  std::string meaning = meaning_at(difference.path);
  meaning = meaning.substr(0, meaning.find(';'));
  if (!difference.entry.empty()) meaning += " (" + difference.entry + ")";
  return fmt::format("  {:<46} {:>13} {:>13} {:>9}  {}\n", difference.path, left, right, change_of(difference),
                     meaning);
}

std::string answer_text(const std::filesystem::path& folder) {
  require_results(folder);
  const std::filesystem::path file = folder / "summary.json";
  const nlohmann::json document = io::read_json(file);
  std::string text = folder.string() + "\n";
  try {
    const Summary summary = summary_from(document, file);
    if (!summary.title.empty()) text += "  " + summary.title + "\n";
    for (const std::string& sentence : headline(summary)) text += "  " + sentence + "\n";
  } catch (const core::DataError&) {
    text += "  its summary.json is not one of this version: it is compared by its entries only\n";
  }
  return text;
}

}  // namespace

std::string answers_text(const std::filesystem::path& left, const std::filesystem::path& right) {
  return answer_text(left) + answer_text(right);
}

std::string main_figures_text(const Comparison& comparison) {
  std::vector<const Difference*> chosen;
  for (const auto* pattern : weighty) {
    for (const Difference& difference : comparison.differences)
      if (fits(difference.path, pattern)) chosen.push_back(&difference);
  }
  if (chosen.empty()) return "";
  chosen.resize(std::min(chosen.size(), most_figures));
  std::string text = fmt::format("  {:<46} {:>13} {:>13} {:>9}\n", "the figures that matter most", "the first",
                                 "the second", "change");
  for (const Difference* difference : chosen) text += row(*difference);
  return text;
}

std::string differences_by_file(const Comparison& comparison) {
  std::vector<std::pair<std::string, std::size_t>> counts;
  for (const Difference& difference : comparison.differences) {
    const std::string file = difference.where.substr(0, difference.where.find(": "));
    const auto found = std::ranges::find(counts, file, &std::pair<std::string, std::size_t>::first);
    if (found == counts.end()) {
      counts.emplace_back(file, 1);
    } else {
      ++found->second;
    }
  }
  std::string text;
  for (const auto& [file, count] : counts) text += fmt::format("{}{} in {}", text.empty() ? "" : ", ", count, file);
  return text;
}

}  // namespace thinwall::report

#include "report/page/limit_text.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace thinwall::report {

namespace {

std::string depth_limit_in_words(const std::optional<CuttingSummary>& cutting) {
  return in_words(cutting ? cutting->depth_limit_is : "depth_limit");
}

/// The limit of a row at the case's speed, of a chart or of a path.
template <class Row>
Limit at_speed(const Row& row, const std::optional<CuttingSummary>& cutting) {
  Limit limit{row.limiting_depth_m, fmt::format(" at {:.0f} rpm", row.spindle_speed_rpm), is_sound(row.status), "", ""};
  if (row.at_depth_limit) limit.of_depth_limit = depth_limit_in_words(cutting);
  return limit;
}

/// " (tool length; weakest at position 6 of 7)".
std::string remarks(const Limit& limit) {
  std::string text = limit.of_depth_limit;
  if (!limit.more.empty()) text += (text.empty() ? "" : "; ") + limit.more;
  return text.empty() ? "" : " (" + text + ")";
}

}  // namespace

std::string millimetres(double metres) {
  return fmt::format("{:.3g} mm", 1e3 * metres);
}

std::string in_words(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

std::string capital(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

bool is_sound(const std::string& status) {
  return status == "converged" || status == "stable_to_depth_limit" || status == "data_limited";
}

std::string range_text(const std::optional<DepthErrorsSummary>& errors) {
  if (!errors || !errors->identification) return "";
  return fmt::format(", 95 %: {:.3g} to {}", 1e3 * errors->identification->low_m,
                     millimetres(errors->identification->high_m));
}

std::string text_of(const Limit& limit) {
  return (limit.converged ? "stable up to " : "not converged: ") + millimetres(limit.depth_m) + limit.at +
         remarks(limit) + limit.range + limit.provided;
}

std::string short_text_of(const Limit& limit) {
  return (limit.converged ? "" : "not converged, ") + millimetres(limit.depth_m) + remarks(limit);
}

Limit limit_of_chart(const LobesSummary& chart, const std::optional<CuttingSummary>& cutting) {
  if (const auto& row = chart.at_case_speed) {
    Limit limit = at_speed(*row, cutting);
    limit.range = range_text(row->error_budget);
    if (row->contact && row->contact->lost_above_m)
      limit.provided = " if the contact holds; it is lost above " + millimetres(*row->contact->lost_above_m);
    return limit;
  }
  Limit limit{chart.minimum_depth_m, " at every speed", chart.speeds_not_converged == 0, "", ""};
  if (chart.error_budget) limit.range = range_text(chart.error_budget->at_minimum);
  if (chart.speeds_stable_to_depth_limit == chart.speeds) limit.of_depth_limit = depth_limit_in_words(cutting);
  if (!limit.converged)
    limit.more = fmt::format("{} of {} speeds did not reach the tolerance", chart.speeds_not_converged, chart.speeds);
  return limit;
}

Limit limit_of_path(const PathSummary& path, const std::optional<CuttingSummary>& cutting) {
  const auto weakest = [&](int position) {
    return fmt::format("weakest at position {} of {}", position, path.positions.size());
  };
  if (const auto& row = path.at_case_speed) {
    Limit limit = at_speed(*row, cutting);
    if (limit.of_depth_limit.empty()) limit.more = weakest(row->limited_at_position);
    limit.converged = row->positions_not_converged == 0;
    return limit;
  }
  Limit limit{path.weakest.minimum_depth_m, " at every speed", path.rows_not_converged == 0, "", ""};
  if (path.weakest.speeds_stable_to_depth_limit == path.speeds) {
    limit.of_depth_limit = depth_limit_in_words(cutting);
  } else {
    limit.more = weakest(path.weakest.position);
  }
  return limit;
}

}  // namespace thinwall::report

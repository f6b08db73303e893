#include "report/page/limit_text.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace thinwall::report {

namespace {

using nlohmann::json;

std::string depth_limit_in_words(const json& cutting) {
  return in_words(cutting.value("depth_limit_is", "depth_limit"));
}

Limit at_speed(const json& row, const json& cutting) {
  Limit limit{row.at("limiting_depth_m").get<double>(),
              fmt::format(" at {:.0f} rpm", row.at("spindle_speed_rpm").get<double>()), is_sound(row), "", ""};
  if (row.at("at_depth_limit").get<bool>()) limit.of_depth_limit = depth_limit_in_words(cutting);
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

bool is_sound(const json& row) {
  const std::string status = row.value("status", "converged");
  return status == "converged" || status == "stable_to_depth_limit";
}

std::string text_of(const Limit& limit) {
  return (limit.converged ? "stable up to " : "not converged: ") + millimetres(limit.depth_m) + limit.at +
         remarks(limit);
}

std::string short_text_of(const Limit& limit) {
  return (limit.converged ? "" : "not converged, ") + millimetres(limit.depth_m) + remarks(limit);
}

Limit limit_of_chart(const json& chart, const json& cutting) {
  if (chart.contains("at_case_speed")) return at_speed(chart.at("at_case_speed"), cutting);
  Limit limit{chart.at("minimum_depth_m").get<double>(), " at every speed", true, "", ""};
  limit.converged = chart.value("speeds_not_converged", 0) == 0;
  if (chart.at("speeds_stable_to_depth_limit") == chart.at("speeds"))
    limit.of_depth_limit = depth_limit_in_words(cutting);
  if (!limit.converged)
    limit.more = fmt::format("{} of {} speeds did not reach the tolerance", chart.at("speeds_not_converged").get<int>(),
                             chart.at("speeds").get<int>());
  return limit;
}

Limit limit_of_path(const json& path, const json& cutting) {
  const std::size_t positions = path.at("positions").size();
  const auto weakest = [&](int position) { return fmt::format("weakest at position {} of {}", position, positions); };
  if (path.contains("at_case_speed")) {
    const json& row = path.at("at_case_speed");
    Limit limit = at_speed(row, cutting);
    if (limit.of_depth_limit.empty()) limit.more = weakest(row.at("limited_at_position").get<int>());
    limit.converged = row.at("positions_not_converged").get<int>() == 0;
    return limit;
  }
  const json& least = path.at("weakest");
  Limit limit{least.at("minimum_depth_m").get<double>(), " at every speed", true, "", ""};
  limit.converged = path.at("rows_not_converged").get<int>() == 0;
  if (least.at("speeds_stable_to_depth_limit") == path.at("speeds")) {
    limit.of_depth_limit = depth_limit_in_words(cutting);
  } else {
    limit.more = weakest(least.at("position").get<int>());
  }
  return limit;
}

}  // namespace thinwall::report

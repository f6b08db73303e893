#include "report/lobes/lobes_words.hpp"

#include <spdlog/fmt/fmt.h>

namespace thinwall::report {

std::string depth_text(double depth_m, bool at_limit) {
  return fmt::format("{}{:.3f} mm", at_limit ? "over " : "", depth_m * 1e3);
}

std::string chart_title(study::ChartOf chart) {
  switch (chart) {
    case study::ChartOf::part:
      return "part alone";
    case study::ChartOf::supported:
      return "with the robot";
    case study::ChartOf::carried:
      return "tool on robot";
    case study::ChartOf::tool:
      break;
  }
  return "tool";
}

std::string best_pocket_title(const LobesSummary& chart) {
  if (chart.best_pocket && chart.best_pocket->at_chart_edge) return "edge of the chart";
  return chart.robust ? "best robust pocket" : "best pocket";
}

std::string width_text(const PocketSummary& pocket) {
  return fmt::format("{:.0f} to {:.0f} rpm", pocket.from_spindle_speed_rpm, pocket.to_spindle_speed_rpm);
}

double total_seconds(const Summary& summary) {
  const auto total = summary.timings_s.find("total");
  return total == summary.timings_s.end() ? 0.0 : total->second;
}

}  // namespace thinwall::report

#include "report/lobes_words.hpp"

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
    case study::ChartOf::tool:
      break;
  }
  return "tool";
}

double total_seconds(const Summary& summary) {
  const auto total = summary.timings_s.find("total");
  return total == summary.timings_s.end() ? 0.0 : total->second;
}

}  // namespace thinwall::report

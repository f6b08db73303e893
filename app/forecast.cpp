#include "app/forecast.hpp"

#include <algorithm>

#include "app/stage_display.hpp"
#include "case/checks/mesh_size.hpp"
#include "study/part/part_forecast.hpp"

namespace thinwall::app {

namespace {

setup::PartSize size_of(const cases::Case& source) {
  study::require_points_hold(source);
  const auto first = study::forecast(study::part_input(source));
  return first ? *first : cases::estimate_size(source);
}

}  // namespace

Forecast forecast(const cases::Case& source) {
  Forecast result;
  if (source.part) result.part = size_of(source);
  result.lobes = study::forecast_lobes(source);
  return result;
}

std::string about(double seconds, bool at_least) {
  return (at_least ? "over " : "about ") + duration_text(std::max(1.0, seconds));
}

std::string text(const Forecast& forecast) {
  std::string line = "this takes " + about(forecast.whole_s(), forecast.at_least());
  if (forecast.part_s() >= 1.0 && forecast.lobes_s() >= 1.0)
    line += ": the part " + about(forecast.part_s()) + ", the lobes " + about(forecast.lobes_s(), forecast.at_least());
  return line;
}

}  // namespace thinwall::app

#include "app/forecast.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <tuple>

#include "app/stage_display.hpp"
#include "case/checks/mesh_size.hpp"
#include "core/error.hpp"
#include "study/identification_forecast.hpp"
#include "study/part/discretisation.hpp"
#include "study/part/part_forecast.hpp"

namespace thinwall::app {

namespace {

setup::PartSize size_of(const cases::Case& source, const study::PartInput& part,
                        const std::shared_ptr<const fem::FirstMesh>& mesh) {
  const auto first = study::forecast(part, mesh);
  return first ? *first : cases::estimate_size(source);
}

}  // namespace

Forecast forecast(const cases::Case& source) {
  Forecast result;
  result.identification_s = study::forecast_identification(source);
  if (source.part) {
    study::require_points_hold(source);
    const study::PartInput part = study::part_input(source);
    result.first_mesh = study::first_mesh(part);
    result.part = size_of(source, part, result.first_mesh);
  }
  result.lobes = study::forecast_lobes(source);
  if (result.lobes && !result.lobes->refusal.empty()) throw core::InputError(result.lobes->refusal);
  result.simulation = study::forecast_simulation(source);
  return result;
}

std::string about(double seconds, bool at_least) {
  return (at_least ? "over " : "about ") + duration_text(std::max(1.0, seconds));
}

std::string text(const Forecast& forecast) {
  const std::string line = "this takes " + about(forecast.whole_s(), forecast.at_least());
  const std::array<std::tuple<const char*, double, bool>, 4> pieces{
      {{"the identification ", forecast.identification_s, false},
       {"the part ", forecast.part_s(), false},
       {"the lobes ", forecast.lobes_s(), forecast.at_least()},
       {"the simulation ", forecast.simulation_s(), false}}};
  std::string list;
  int told = 0;
  for (const auto& [name, seconds, at_least] : pieces) {
    if (seconds < 1.0) continue;
    list += (told++ == 0 ? ": " : ", ") + (name + about(seconds, at_least));
  }
  return told > 1 ? line + list : line;
}

std::shared_ptr<const fem::FirstMesh> tell_of_long_run(const cases::Case& source) {
  constexpr double long_s = 10.0;
  try {
    const Forecast time = forecast(source);
    if (time.at_least() || time.whole_s() >= long_s) spdlog::info("{}", text(time));
    return time.first_mesh;
  } catch (const core::Interrupted&) {
    throw;
  } catch (const core::Error&) {
    return {};
  }
}

}  // namespace thinwall::app

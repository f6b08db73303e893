#include "app/forecast.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <optional>
#include <tuple>

#include "app/stage_display.hpp"
#include "case/checks/mesh_size.hpp"
#include "core/error.hpp"
#include "core/time_limit.hpp"
#include "setup/part_geometry.hpp"
#include "study/identification_forecast.hpp"
#include "study/part/discretisation.hpp"
#include "study/part/part_forecast.hpp"
#include "study/rehearsal.hpp"

namespace thinwall::app {

namespace {

/// The size of the part from its first mesh, which is kept in the forecast; none for a part that needs no file.
std::optional<setup::PartSize> size_by_first_mesh(const study::PartInput& part, Forecast& result) {
  result.first_mesh = study::first_mesh(part);
  return study::forecast(part, result.first_mesh);
}

/// The size of the part, by its walls where the first mesh is not there within `limit_s`: the time is then the least.
setup::PartSize size_of(const cases::Case& source, std::optional<double> limit_s, Forecast& result) {
  const study::PartInput part = study::part_input(source);
  bool over = false;
  std::optional<setup::PartSize> first;
  try {
    std::optional<core::TimeLimit> limit;
    if (limit_s) limit.emplace(*limit_s);
    first = size_by_first_mesh(part, result);
  } catch (const core::TimeIsOver&) {
    over = true;
  }
  setup::PartSize size = first ? *first : cases::estimate_size(source);
  if (over) size.seconds = std::max(size.seconds, *limit_s);
  size.at_least = over || !setup::unreachable_tolerances(source).empty();
  return size;
}

/// forecast(), with a refusal of the tool's lines left in it; `mesh_limit_s` bounds the time of the first mesh, if
/// given.
Forecast unrefused_forecast(const cases::Case& source, const std::vector<milling::OperatingPoint>& points,
                            std::optional<double> mesh_limit_s) {
  Forecast result;
  result.identification_s = study::forecast_identification(source);
  if (source.part) {
    study::require_points_hold(source);
    result.part = size_of(source, mesh_limit_s, result);
  }
  const auto modes = [&] { return study::rehearsed_modes(source, result.first_mesh); };
  result.lobes = study::forecast_lobes(source, study::forecast_limit_s, points, modes);
  if (!result.refused()) result.simulation = study::forecast_simulation(source);
  return result;
}

/// Throws the refusal of the tool's lines, if there is one.
void throw_refusal(const Forecast& forecast) {
  if (forecast.refused()) throw core::InputError(forecast.lobes->refusal);
}

/// The forecast of a run; none where it cannot be made, of which the run will tell.
std::optional<Forecast> possible_forecast(const cases::Case& source,
                                          const std::vector<milling::OperatingPoint>& points) {
  try {
    return unrefused_forecast(source, points, std::nullopt);  // the run goes on from the mesh
  } catch (const core::Interrupted&) {
    throw;
  } catch (const core::Error&) {
    return std::nullopt;
  }
}

}  // namespace

Forecast forecast(const cases::Case& source, double mesh_limit_s) {
  Forecast result = unrefused_forecast(source, {}, mesh_limit_s);
  throw_refusal(result);
  return result;
}

std::string about(double seconds, bool at_least) {
  return (at_least ? "over " : "about ") + duration_text(std::max(1.0, seconds));
}

std::string text(const Forecast& forecast) {
  const std::string line = "this takes " + about(forecast.whole_s(), forecast.at_least());
  const std::array<std::tuple<const char*, double, bool>, 4> pieces{
      {{"the identification ", forecast.identification_s, false},
       {"the part ", forecast.part_s(), forecast.part_at_least()},
       {"the lobes ", forecast.lobes_s(), forecast.lobes_at_least()},
       {"the simulation ", forecast.simulation_s(), false}}};
  std::string list;
  int told = 0;
  for (const auto& [name, seconds, at_least] : pieces) {
    if (seconds < 1.0) continue;
    list += (told++ == 0 ? ": " : ", ") + (name + about(seconds, at_least));
  }
  return told > 1 ? line + list : line;
}

std::shared_ptr<const fem::FirstMesh> tell_of_long_run(const cases::Case& source,
                                                       const std::vector<milling::OperatingPoint>& points) {
  constexpr double long_s = 10.0;
  const std::optional<Forecast> time = possible_forecast(source, points);
  if (!time) return {};
  throw_refusal(*time);
  if (time->at_least() || time->whole_s() >= long_s) spdlog::info("{}", text(*time));
  return time->first_mesh;
}

}  // namespace thinwall::app

#pragma once
// The time that a run will take, before it begins.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "case/machining_case.hpp"
#include "fem/closed_part.hpp"
#include "milling/chart/operating_point.hpp"
#include "setup/part_size.hpp"
#include "study/lobes/lobes_forecast.hpp"
#include "study/simulation/simulation_forecast.hpp"

namespace thinwall::app {

/// The expectations of a run before it begins; none of what the case does not have.
struct Forecast {
  double identification_s = 0.0;  ///< of a fitted tool and a learned robot
  std::optional<setup::PartSize> part;
  std::optional<study::LobesForecast> lobes;
  std::optional<study::SimulationForecast> simulation;
  std::shared_ptr<const fem::FirstMesh> first_mesh{};  ///< of the part, if the forecast made one that a run can take

  [[nodiscard]] double part_s() const { return part ? part->seconds : 0.0; }
  [[nodiscard]] double lobes_s() const { return lobes ? lobes->seconds : 0.0; }
  [[nodiscard]] double simulation_s() const { return simulation ? simulation->seconds : 0.0; }
  [[nodiscard]] double whole_s() const { return identification_s + part_s() + lobes_s() + simulation_s(); }
  /// True if it is known only that the run takes as long or longer.
  [[nodiscard]] bool at_least() const { return part_at_least() || lobes_at_least(); }
  [[nodiscard]] bool part_at_least() const { return part && part->at_least; }
  [[nodiscard]] bool lobes_at_least() const { return lobes && lobes->at_least; }
  /// True if the tool's lines do not reach, so that there will be no run.
  [[nodiscard]] bool refused() const { return lobes && !lobes->refusal.empty(); }
};

/// The forecast of a case: the part from its first mesh where a file holds it (study::forecast()), else by
/// cases::estimate_size(), study::forecast_identification(), study::forecast_lobes() and study::forecast_simulation().
/// Throws InputError for points that do not hold the part and lines that do not reach, and as study::forecast(). Cost:
/// a second as a rule; up to seven for charts, their modes (study::rehearsed_modes()) among them, half a one for a
/// simulation, and `mesh_limit_s` for the first mesh: where it takes longer the part's time is
/// cases::estimate_size()'s, as the least.
[[nodiscard]] Forecast forecast(const cases::Case& source, double mesh_limit_s = 8.0);

/// "about 3 min" or, of what is only known to be longer, "over 3 min"; a second at least.
[[nodiscard]] std::string about(double seconds, bool at_least = false);

/// A line that says the whole time and what it consists of.
[[nodiscard]] std::string text(const Forecast& forecast);

/// Logs that line for a case that takes ten seconds or longer, or of which only the least is known: rows that take too
/// long to be timed, a tolerance that is not met. What cannot be foreseen is an error of the run, which tells it where
/// it is met. Returns the first mesh of the part for the run, if there is one. Throws Interrupted, and InputError for
/// lines that do not reach, at the `points` of which the charts are asked too. Cost: as forecast().
std::shared_ptr<const fem::FirstMesh> tell_of_long_run(const cases::Case& source,
                                                       const std::vector<milling::OperatingPoint>& points = {});

}  // namespace thinwall::app

#include "study/simulation/simulation_forecast.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/parallel.hpp"
#include "core/time_limit.hpp"
#include "milling/simulation/exact_path.hpp"
#include "milling/simulation/march_grid.hpp"
#include "milling/simulation/region_path.hpp"
#include "setup/milling_process.hpp"
#include "setup/simulation_faults.hpp"
#include "setup/simulation_options.hpp"
#include "study/lobes/stand_in.hpp"

namespace thinwall::study {

namespace {

/// A long march, which tells of each of its turns.
using March = std::function<void(const milling::TurnObserver& after_turn)>;

/// Seconds a turn, from as many turns as a quarter of a second holds; the first, in which memory is taken, counts only
/// where there is no other.
double seconds_a_turn(const March& march) {
  using Clock = std::chrono::steady_clock;
  constexpr double enough_s = 0.25;
  const auto start = Clock::now();
  auto first = start, last = start;
  int turns = 0;
  try {
    const core::TimeLimit limit(enough_s);
    march([&](double /*share*/) {
      last = Clock::now();
      if (turns++ == 0) first = last;
      core::check_interrupt();
    });
  } catch (const core::TimeIsOver&) {
  }
  const std::chrono::duration<double> all = last - start, later = last - first;
  return turns > 1 ? later.count() / (turns - 1) : all.count();
}

/// The point that is timed: the first, else one at a tenth of the tool's length.
milling::SimulatedPoint timed_point(const setup::Setup& source, double feed_per_tooth_m) {
  constexpr double usual_share = 0.1;
  if (!source.simulation->points.empty()) {
    const milling::OperatingPoint& first = source.simulation->points.front();
    return {first.spindle_speed_rpm, first.depth_m, feed_per_tooth_m};
  }
  return {source.cutting->spindle_speed_rpm.value_or(5000.0), usual_share * source.tool->length, feed_per_tooth_m};
}

/// The cut on modes that stand in for the part's.
struct StandInCut {
  milling::RelativeStructure structure;
  milling::MillingProcess process;
  milling::ForceLaw law;
  double feed_per_tooth_m = 0.0;
};

double point_turn_s(const setup::Setup& source, const StandInCut& cut) {
  const setup::Simulation& wanted = *source.simulation;
  // A part of a million turns would not fit into memory, and an arm would not feed so far.
  const double longer = wanted.paths == setup::ToothPaths::region         ? 10.0
                        : wanted.robot == setup::CarrierMotion::multibody ? 4.0
                                                                          : 1.0;
  milling::SimulationOptions options = setup::simulation_options(wanted, 1.0, 1);
  options.settling_turns = 0;
  options.recorded_turns = 1000000;
  options.traced_turns = options.wall.turns = 0;
  const milling::SimulatedPoint point = timed_point(source, cut.feed_per_tooth_m);
  return longer * seconds_a_turn([&](const milling::TurnObserver& look) {
           if (wanted.paths == setup::ToothPaths::circular) {
             (void)milling::simulate(cut.structure, cut.process, cut.law, point, options, look);
           } else {
             (void)milling::simulate_exact_path(cut.structure, cut.process, cut.law, point,
                                                setup::stock_of(wanted, *source.cutting, cut.process.cutter), options,
                                                setup::path_options(wanted), look);
           }
         });
}

double map_turn_s(const setup::SimulationMap& map, const StandInCut& cut) {
  milling::SimulationOptions options = setup::map_options(map);
  options.settling_turns = 1000000;
  const milling::SimulatedPoint middle{0.5 * (map.from_rpm + map.to_rpm), 0.5 * map.depth_limit_m,
                                       cut.feed_per_tooth_m};
  return seconds_a_turn([&](const milling::TurnObserver& look) {
    (void)milling::simulate(cut.structure, cut.process, cut.law, middle, options, look);
  });
}

/// The memory of a part that is kept as a region: the polygons of all cells of the window, slice by slice, and the
/// corners that the teeth leave on its walls, there and in the surface that is written; bytes as they were measured.
double region_bytes(const setup::Setup& source, const StandInCut& cut, const milling::SimulationOptions& options) {
  constexpr double cells_a_radius = 20.0, bytes_a_cell = 350.0, bytes_a_pass = 8000.0;
  if (source.simulation->paths != setup::ToothPaths::region) return 0.0;
  const milling::SimulatedPoint point = timed_point(source, cut.feed_per_tooth_m);
  const int turns = options.settling_turns + options.recorded_turns;
  const milling::CutWindow window = milling::cut_window(cut.process, point, turns);
  const double cell_m = 0.5 * cut.process.cutter.diameter_m / cells_a_radius;
  const double cells = (window.high - window.low).prod() / (cell_m * cell_m);
  const auto slices = static_cast<double>(milling::discs_of(cut.process, point.depth_m, options.steps).size());
  return slices * (cells * bytes_a_cell + bytes_a_pass * turns * cut.process.cutter.teeth);
}

SimulationForecast forecast_of(const setup::Setup& source, const StandInCut& cut) {
  const setup::Simulation& wanted = *source.simulation;
  const auto options = setup::simulation_options(wanted, cut.feed_per_tooth_m, cut.process.cutter.teeth);
  const bool around_boundary = wanted.points.empty() && source.cutting->spindle_speed_rpm;
  const double points = around_boundary ? 2.0 : static_cast<double>(wanted.points.size());
  SimulationForecast result;
  result.points = static_cast<double>(setup::simulated_structures(source).size()) * points;
  const double point_turns = result.points * (options.settling_turns + options.recorded_turns);
  if (result.points > 0.0) {
    const double together = std::min<double>(core::thread_count(), result.points);
    result.seconds = point_turns * point_turn_s(source, cut) / together;
  }
  result.turns = point_turns;
  result.memory_bytes = std::min<double>(core::thread_count(), result.points) * region_bytes(source, cut, options);
  if (!wanted.map) return result;
  result.map_points =
      static_cast<double>(setup::simulated_structures(source).size()) * wanted.map->speeds * wanted.map->depths;
  result.turns += result.map_points * wanted.map->turns;
  result.seconds += result.map_points * wanted.map->turns * map_turn_s(*wanted.map, cut) / core::thread_count();
  return result;
}

}  // namespace

std::optional<SimulationForecast> forecast_simulation(const setup::Setup& source) {
  if (!source.simulation || !source.cutting || !source.tool) return std::nullopt;
  try {
    const auto feed = setup::feed_per_tooth(source);
    auto poles = poles_like(source);
    if (!feed || !poles) return std::nullopt;
    const milling::MillingProcess process = setup::milling_process(source);
    return forecast_of(source, {std::move(*poles), process, setup::force_law(*source.cutting, process), *feed});
  } catch (const core::Interrupted&) {
    throw;
  } catch (const core::Error&) {
    return std::nullopt;
  }
}

}  // namespace thinwall::study

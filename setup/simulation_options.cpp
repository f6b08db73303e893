#include "setup/simulation_options.hpp"

#include <algorithm>
#include <cmath>

namespace thinwall::setup {

namespace {

constexpr int least_wall_turns = 4;

int recorded_turns(const Simulation& simulation, double feed_a_turn_m) {
  constexpr double most = 1e7;  // as the case's keys allow
  if (!simulation.length_m || !std::isfinite(*simulation.length_m) || !(feed_a_turn_m > 0.0)) return simulation.turns;
  return static_cast<int>(std::clamp(std::ceil(*simulation.length_m / feed_a_turn_m), 1.0, most));
}

}  // namespace

milling::SimulationOptions simulation_options(const Simulation& simulation, double feed_per_tooth_m, int teeth) {
  milling::SimulationOptions options;
  options.settling_turns = simulation.settling_turns;
  options.recorded_turns = recorded_turns(simulation, teeth * feed_per_tooth_m);
  options.traced_turns = std::min(simulation.traced_turns, options.recorded_turns);
  const int walled = std::min(simulation.wall_turns, options.recorded_turns);
  options.wall.turns = walled < least_wall_turns ? 0 : walled;
  options.wall.heights_m = simulation.wall_heights_m;
  options.wall.cutoff_m = simulation.wall_cutoff_m.value_or(0.0);
  options.steps.steps_in_cut = simulation.steps;
  if (simulation.start == CutStart::border) {
    options.settling_turns = 0;
    options.traced_turns = options.recorded_turns;
    constexpr int samples_a_tooth = 24;  // of a long trace
    options.samples_a_turn = teeth * samples_a_tooth;
    options.means_a_turn = teeth;
  }
  return options;
}

milling::RegionOptions region_options(const Simulation& simulation) {
  milling::RegionOptions options;
  options.steps_a_turn = simulation.steps_a_turn;
  options.edge = simulation.chords ? milling::SweptEdge::chords : milling::SweptEdge::arcs;
  return options;
}

milling::Stock stock_of(const Simulation& simulation, const Cutting& cutting, const milling::Cutter& cutter) {
  const auto direction = cutting.down_milling ? milling::MillingDirection::down : milling::MillingDirection::up;
  milling::Stock stock = milling::shoulder(cutter, *cutting.radial_depth, direction);
  if (simulation.start == CutStart::border) stock.push_back(milling::border_ahead(cutter, 0.0));
  return stock;
}

milling::PathOptions path_options(const Simulation& simulation) {
  milling::PathOptions options;
  options.steps_a_turn = simulation.steps_a_turn;
  return options;
}

milling::SimulationOptions map_options(const SimulationMap& map) {
  milling::SimulationOptions options;
  options.recorded_turns = std::max(1, map.turns / 4);
  options.settling_turns = map.turns - options.recorded_turns;
  options.steps.steps_in_cut = map.steps;
  options.kept_passes = 2;
  return options;
}

}  // namespace thinwall::setup

#include "case/simulation_binding.hpp"

#include "case/operating_point.hpp"
#include "core/error.hpp"

namespace thinwall::cases {

namespace {

setup::SimulationMap bind_map(const Table& table, const std::optional<setup::LobesOptions>& lobes) {
  setup::SimulationMap map;
  map.speeds = table.integer("speeds");
  map.depths = table.integer("depths");
  map.turns = table.integer("turns");
  map.steps = table.integer("steps");
  map.depth_limit_m = table.optional("deepest").value_or(lobes ? lobes->depth_limit : 0.0);
  if (lobes) {
    map.from_rpm = lobes->from_rpm;
    map.to_rpm = lobes->to_rpm;
  }
  return map;
}

}  // namespace

setup::Simulation bind_simulation(const Table& table, const std::optional<setup::LobesOptions>& lobes) {
  setup::Simulation simulation;
  for (const std::string& text : table.names("at")) {
    try {
      simulation.points.push_back(operating_point(text));
    } catch (const core::InputError&) {  // check_simulation() says why
    }
  }
  for (const std::string& name : table.names("structures"))
    if (const auto of = core::from_word<setup::CutOn>(name)) simulation.structures.push_back(*of);
  simulation.paths = table.choice<setup::ToothPaths>("paths");
  const auto integer = [&](const char* key, int& value) {
    if (const int read = table.integer(key); read >= 0) value = read;  // −1 of none, or of one that is reported
  };
  integer("settling_turns", simulation.settling_turns);
  integer("turns", simulation.turns);
  integer("trace", simulation.traced_turns);
  integer("wall", simulation.wall_turns);
  integer("steps", simulation.steps);
  integer("steps_a_turn", simulation.steps_a_turn);
  simulation.length_m = table.optional("length");
  simulation.start = table.choice<setup::CutStart>("start");
  simulation.chords = table.flag("chords");
  if (const auto heights = table.numbers("wall_heights"); !heights.empty()) simulation.wall_heights_m = heights;
  simulation.wall_cutoff_m = table.optional("wall_cutoff");
  simulation.robot = table.choice<setup::CarrierMotion>("robot");
  simulation.support = table.choice<setup::SupportSides>("support");
  if (const Table map = table.table("map"); map.exists()) simulation.map = bind_map(map, lobes);
  return simulation;
}

}  // namespace thinwall::cases

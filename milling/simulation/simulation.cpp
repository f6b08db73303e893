#include "milling/simulation/simulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "core/error.hpp"
#include "milling/simulation/march.hpp"
#include "milling/simulation/record.hpp"

namespace thinwall::milling {

namespace {

void require_positive(const char* what, double value, const char* unit) {
  if (value > 0.0 && std::isfinite(value)) return;
  std::ostringstream text;
  text << "simulation: " << what << " " << value << " " << unit << ", must be positive; correct it";
  throw core::InputError(text.str());
}

bool within_radius(const CutState& state, double radius_m) {
  // Modes are scaled to their displacement at the cut. The largest of numbers some of which are NaN is any of them.
  return state.modes.allFinite() && state.modes.cwiseAbs().maxCoeff() < radius_m;
}

template <class ChipForce>
SimulatedCut run(const CircularCut& cut, const ChipForce& force, const MillingProcess& process, double feed_per_tooth_m,
                 const SimulationOptions& options, const TurnObserver& after_turn) {
  SimulatedCut result;
  const double radius_m = 0.5 * process.cutter.diameter_m;
  const double feed_m_per_rad = feed_per_tooth_m / process.cutter.pitch_rad();
  Record record(cut.grid.tips, cut.rad_per_s, options, result);
  WallRecorder wall(process, feed_m_per_rad, cut.grid.tips, cut.grid.period_rad, options.wall);
  const auto observe = [&](const MarchStep& step) {
    record(step);
    wall(step);
  };
  March march(cut, force);
  CutState state = at_rest(cut, options.first_force_n);
  const int turns = options.settling_turns + options.recorded_turns;
  const int settling = options.settling_turns * cut.grid.periods_a_turn;
  const int untraced = (turns - options.traced_turns) * cut.grid.periods_a_turn;
  const int unwalled = (turns - options.wall.turns) * cut.grid.periods_a_turn;
  const Unseen unseen;
  long unsettled = 0;
  int period = 0;
  for (int turn = 0; turn < turns && result.status == SimulationStatus::completed; ++turn) {
    for (int i = 0; i < cut.grid.periods_a_turn; ++i, ++period) {
      record.begin_period(period * cut.period_s(), (period - untraced) * cut.grid.period_rad);
      wall.begin_period((period - unwalled) * cut.grid.period_rad);
      unsettled += period < settling ? march.over_period(state, unseen) : march.over_period(state, observe);
    }
    result.simulated_s = period * cut.period_s();
    if (!within_radius(state, radius_m)) result.status = SimulationStatus::overflowed;
    if (after_turn) after_turn((turn + 1.0) / turns);
  }
  if (1000 * unsettled > static_cast<long>(period) * cut.grid.nodes() && result.status == SimulationStatus::completed)
    result.status = SimulationStatus::unsettled;
  result.trace.start_s = untraced * cut.period_s();
  result.walls = wall.walls();
  record.finish(std::max(1, period - settling) * cut.grid.period_rad);
  if (result.status == SimulationStatus::overflowed) result.motion = {Motion::growing, 0, 0.0};
  return result;
}

}  // namespace

std::string name(SimulationStatus status) {
  constexpr std::array<const char*, 3> names{"completed", "overflowed", "unsettled"};
  return names[static_cast<std::size_t>(status)];
}

std::vector<std::string> validate(const SimulationOptions& options) {
  std::vector<std::string> violations = validate(options.steps);
  const auto require = [&](bool holds, const char* what, int value, int least) {
    if (holds) return;
    violations.push_back("simulation: " + std::to_string(value) + " " + what + ", must be at least " +
                         std::to_string(least) + "; correct it");
  };
  require(options.settling_turns >= 0, "turns to settle", options.settling_turns, 0);
  require(options.recorded_turns >= 1, "turns to record", options.recorded_turns, 1);
  require(options.kept_passes >= 2, "passes of teeth to keep", options.kept_passes, 2);
  require(options.samples_a_turn >= 2, "samples a turn", options.samples_a_turn, 2);
  constexpr double most_numbers = 1e8;
  const double numbers = 7.0 * options.traced_turns * static_cast<double>(options.samples_a_turn);
  if (numbers > most_numbers) {
    std::ostringstream text;
    text << "simulation: a trace of " << numbers << " numbers, must be at most " << most_numbers
         << "; trace fewer turns or take fewer samples a turn";
    violations.push_back(text.str());
  }
  const int walled = options.wall.turns;
  constexpr double numbers_a_turn = 1000.0;  // of tip paths, a height and some teeth
  if (walled * numbers_a_turn * static_cast<double>(options.wall.heights_m.size()) > most_numbers) {
    violations.push_back("simulation: " + std::to_string(walled) + " turns of wall at " +
                         std::to_string(options.wall.heights_m.size()) +
                         " heights, must be at most 100000 together; record fewer turns or heights");
  }
  if (walled != 0 && (walled < 4 || walled > options.recorded_turns)) {
    violations.push_back("simulation: " + std::to_string(walled) + " turns of wall, must be 0, or 4 to the " +
                         std::to_string(options.recorded_turns) + " that are recorded; correct it");
  }
  if (options.traced_turns < 0 || options.traced_turns > options.recorded_turns) {
    violations.push_back("simulation: " + std::to_string(options.traced_turns) + " turns to trace, must be 0 to the " +
                         std::to_string(options.recorded_turns) + " that are recorded; correct it");
  }
  return violations;
}

void require_usable(const MillingProcess& process, const ForceLaw& law, const SimulatedPoint& point,
                    const SimulationOptions& options) {
  require_valid(validate(process));
  require_valid(validate(law));
  require_valid(validate(options));
  require_positive("spindle speed", point.spindle_speed_rpm, "rpm");
  require_positive("depth", point.depth_m, "m");
  require_positive("feed per tooth", point.feed_per_tooth_m, "m");
  for (const double height : options.wall.heights_m) {
    if (height >= 0.0 && height <= point.depth_m) continue;
    std::ostringstream text;
    text << "simulation: wall at " << height << " m height, must be 0 to the depth of " << point.depth_m
         << " m; correct it";
    throw core::InputError(text.str());
  }
}

SimulatedCut simulate(const RelativeStructure& structure, const MillingProcess& process, const ForceLaw& law,
                      const SimulatedPoint& point, const SimulationOptions& options, const TurnObserver& after_turn) {
  require_usable(process, law, point, options);
  const CircularCut cut =
      circular_cut(structure, process, point.spindle_speed_rpm, point.depth_m, point.feed_per_tooth_m, options.steps);
  return with_chip_force(process, law, [&](const auto& chip_force) {
    return run(cut, chip_force, process, point.feed_per_tooth_m, options, after_turn);
  });
}

}  // namespace thinwall::milling

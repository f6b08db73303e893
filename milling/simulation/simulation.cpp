#include "milling/simulation/simulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <sstream>

#include "core/error.hpp"
#include "milling/simulation/march.hpp"
#include "milling/simulation/turns.hpp"

namespace thinwall::milling {

namespace {

void require_positive(const char* what, double value, const char* unit) {
  if (value > 0.0 && std::isfinite(value)) return;
  std::ostringstream text;
  text << "simulation: " << what << " " << value << " " << unit << ", must be positive; correct it";
  throw core::InputError(text.str());
}

/// Throws InputError for a filter that leaves nothing of the recorded wall.
void require_filter(const WallOptions& wall, double feed_a_turn_m) {
  if (wall.turns == 0 || wall.cutoff_m == 0.0) return;
  const double profile_m = recorded_length_m(wall, feed_a_turn_m);
  if (wall.cutoff_m > 0.0 && 2.0 * wall.cutoff_m < profile_m) return;
  std::ostringstream text;
  text << "simulation: a filter of " << wall.cutoff_m << " m cutoff takes as much from either end of a wall of "
       << profile_m << " m; record more turns of it, or take a shorter one";
  throw core::InputError(text.str());
}

/// The march of a circular cut from rest.
template <class ChipForce>
class CircularMotion {
 public:
  /// Keeps references to both.
  CircularMotion(const CircularCut& cut, const ChipForce& force, const Eigen::Vector3d& first_force_n)
      : march_(cut, force), state_(at_rest(cut, first_force_n)), periods_{cut.grid.tips,       false,
                                                                          cut.grid.period_rad, cut.grid.periods_a_turn,
                                                                          cut.grid.nodes(),    cut.rad_per_s} {}

  [[nodiscard]] const Periods& periods() const { return periods_; }

  template <class Observer>
  long over_period(Observer& see) {
    return march_.over_period(state_, see);
  }

  /// A surface is kept however old it is.
  [[nodiscard]] static long surfaces_lost() { return 0; }

  /// Circles clear what their chips are, by the very surface that is handed on.
  [[nodiscard]] static std::optional<double> cleared_m2() { return {}; }

  /// Modes are scaled to their displacement at the cut. The largest of numbers some of which are NaN is any of them.
  [[nodiscard]] bool within(double radius_m) const {
    return state_.modes.allFinite() && state_.modes.cwiseAbs().maxCoeff() < radius_m;
  }

 private:
  March<ChipForce> march_;
  CutState state_;
  Periods periods_;
};

}  // namespace

std::string name(SimulationStatus status) {
  constexpr std::array<const char*, 5> names{"completed", "overflowed", "unsettled", "surface_lost", "too_coarse"};
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
  require(options.means_a_turn >= 0, "means a turn", options.means_a_turn, 0);
  constexpr double most_numbers = 1e8;
  const double numbers = 7.0 * options.traced_turns * static_cast<double>(options.samples_a_turn) +
                         3.0 * options.recorded_turns * static_cast<double>(options.means_a_turn);
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
  require_filter(options.wall, point.feed_per_tooth_m * process.cutter.teeth);
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
  const double feed_m_per_rad = point.feed_per_tooth_m / process.cutter.pitch_rad();
  return with_chip_force(process, law, [&](const auto& chip_force) {
    CircularMotion motion(cut, chip_force, options.first_force_n);
    return over_turns(motion, process, feed_m_per_rad, options, after_turn);
  });
}

Eigen::Vector3d mean_force_of_rigid_tool(const MillingProcess& process, const ForceLaw& law,
                                         const SimulatedPoint& point) {
  constexpr double pole_rad_s = 1e5, stiffness_n_per_m = 1e18;
  RelativeStructure rigid{Eigen::VectorXcd(2), Eigen::Matrix3Xcd::Zero(3, 2), Eigen::Matrix3Xcd::Zero(3, 2)};
  rigid.poles.setConstant({-0.1 * pole_rad_s, pole_rad_s});
  rigid.phi.leftCols<2>() = process.frame.rotation().leftCols<2>().cast<std::complex<double>>();
  rigid.b = rigid.phi * std::complex<double>(0.0, -0.5 * pole_rad_s / stiffness_n_per_m);
  SimulationOptions options;
  options.settling_turns = process.cutter.teeth;  // runout leaves a surface to the teeth of a turn
  options.recorded_turns = 1;
  return simulate(rigid, process, law, point, options).mean_force_n;
}

}  // namespace thinwall::milling

#pragma once
// The simulation in the time domain that is asked for.

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "core/words.hpp"
#include "milling/chart/operating_point.hpp"

namespace thinwall::setup {

/// The paths of teeth.
enum class ToothPaths {
  circular,  ///< on circles, between fixed angles of entry and exit (milling/simulation/circular_cut.hpp)
  exact,     ///< on their real paths (milling/simulation/exact_path.hpp)
  region     ///< on their real paths, through a part that is kept as a region (milling/simulation/region_path.hpp)
};

/// The place of the tool when a simulation begins.
enum class CutStart {
  steady,  ///< within the material, which it has cut so far without vibration
  loaded,  ///< likewise, at rest under the mean force of the cut, so that slow modes have little to settle
  border   ///< outside, touching a straight border across the feed
};

/// The model of a robot that carries the tool.
enum class CarrierMotion {
  linear,    ///< small vibrations about its posture, as in the lobes
  multibody  ///< a nonlinear arm that feeds through the cut (study/simulation/arm_pass.hpp)
};

/// The behaviour of a support's contact when the cut pulls at it.
enum class SupportSides {
  two_sided,  ///< it holds, as in the lobes
  one_sided   ///< it opens (milling/simulation/one_sided_contact.hpp)
};

/// The structures that a cut may be simulated on.
enum class CutOn {
  part,       ///< the part alone
  supported,  ///< the part with the robot that supports it
  tool,       ///< a tool that cuts a rigid part
  carried     ///< a tool on a robot that carries it, which cuts the part, or a rigid one
};

/// A map of the vibration over speed and depth, by circular paths.
struct SimulationMap {
  int speeds = 60;  ///< evenly from lobes.from to lobes.to
  int depths = 40;  ///< evenly up to the largest
  double from_rpm = 0.0, to_rpm = 0.0;
  double depth_limit_m = 0.0;
  int turns = 200;  ///< of each point, of which the last quarter is recorded
  int steps = 50;   ///< of a tooth from entry to exit
};

/// Operating points and how they are simulated.
struct Simulation {
  std::vector<milling::OperatingPoint> points;  ///< empty: those that are asked for elsewhere, else points on both
                                                ///< sides of the boundary at the case's own speed
  std::vector<CutOn> structures;                ///< empty: all that the case has
  ToothPaths paths = ToothPaths::circular;
  int settling_turns = 400;                    ///< before anything is recorded
  int turns = 200;                             ///< that are recorded, unless `length_m` says so
  std::optional<double> length_m;              ///< of the path that is recorded
  int traced_turns = 50;                       ///< the last of them, sample by sample; fewer where fewer are recorded
  int wall_turns = 20;                         ///< likewise, whose wall is recorded; none where fewer than 4 are
  std::vector<double> wall_heights_m = {0.0};  ///< above the tip
  std::optional<double> wall_cutoff_m;         ///< of the Gaussian filter that takes long waves out of a wall
  int steps = 200;                             ///< of a tooth from entry to exit, on circular paths
  int steps_a_turn = 720;                      ///< on exact paths and in a region
  CutStart start = CutStart::steady;
  bool chords = false;  ///< in a region, tips move in one chord a step
  SupportSides support = SupportSides::two_sided;
  CarrierMotion robot = CarrierMotion::linear;
  std::optional<SimulationMap> map;
};

}  // namespace thinwall::setup

namespace thinwall::core {

template <>
inline constexpr std::array<std::string_view, 3> words<setup::ToothPaths>{"circular", "exact", "region"};
template <>
inline constexpr std::array<std::string_view, 3> words<setup::CutStart>{"steady", "loaded", "border"};
template <>
inline constexpr std::array<std::string_view, 2> words<setup::CarrierMotion>{"linear", "multibody"};
template <>
inline constexpr std::array<std::string_view, 2> words<setup::SupportSides>{"two_sided", "one_sided"};
template <>
inline constexpr std::array<std::string_view, 4> words<setup::CutOn>{"part", "supported", "tool", "carried"};

}  // namespace thinwall::core

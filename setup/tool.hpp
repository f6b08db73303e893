#pragma once
// The cutter and the motion of its tip.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/words.hpp"
#include "dynamics/modal_model.hpp"
#include "dynamics/modal_table.hpp"
#include "setup/measured_frf.hpp"
#include "setup/robot.hpp"

namespace thinwall::setup {

/// Shapes of a tool's end.
enum class ToolEnd {
  flat,
  ball,
  bull_nose,
  general,  ///< a torus between two cones
};

/// Rotations at the tip of the measured tool.
enum class SwapRotations { none, second_difference, corrected, rank_one };

/// A cylinder of a tool, in order from the tip to the root.
struct ToolStep {
  double length = 0.0;                                ///< m
  double outer_diameter = 0.0, inner_diameter = 0.0;  ///< m
  double youngs_modulus = 0.0, poisson_ratio = 0.0, density = 0.0;
};

/// The tip of a tool from FRFs that were measured with another in its place, or from the modes of the robot that
/// carries it.
struct ToolSwap {
  std::vector<MeasuredFrf> measured;  ///< between two directions of two points; none: `table` is in their place
  std::string tip, up;                ///< names of the points
  double distance = 0.0;              ///< m, of `up` from the tip
  SwapRotations rotations = SwapRotations::none;
  std::vector<ToolStep> reference, target;
  std::optional<double> to_hz = {};                        ///< last line of `table`; none: its highest mode
  std::shared_ptr<const dynamics::ModalTable> table = {};  ///< modes of both points, part axes, of the robot's table
                                                           ///< once it is read or learned (setup/identified/)
};

/// The modes that were fitted to a measured tip, DOFs tool.x …, and what is to be said of the fit.
struct FittedTip {
  dynamics::ModalModel model;
  std::vector<dynamics::ModalModel> drawn;  ///< models that lines with another noise would have given
  std::vector<std::string> notes, warnings;
};

/// The cutter, and the motion of its tip.
struct Tool {
  int teeth = 0;
  double diameter = 0.0;        ///< m
  double length = 0.0;          ///< m
  std::vector<double> pitches;  ///< rad; empty: equal
  std::vector<double> helices;  ///< rad, one a tooth; empty: none
  std::vector<double> runout;   ///< m, one a tooth; empty: none
  ToolEnd end = ToolEnd::flat;
  double corner_radius = 0.0;                      ///< m; of bull_nose and general, the next four of general alone
  double corner_radial = 0.0, corner_axial = 0.0;  ///< m
  double tip_angle = 0.0, taper = 0.0;             ///< rad
  std::vector<TipMode> modes;
  std::vector<MeasuredFrf> measured;             ///< DOFs "tool.x", "tool.y", "tool.z"
  bool fit = false;                              ///< poles are fitted to `measured` and stand in its place
  std::shared_ptr<const FittedTip> fitted = {};  ///< these, once they are found (setup/identified/)
  std::optional<ToolSwap> swap;
};

/// True of a tool whose tip has no poles of its own: measured lines that are not fitted, or a swapped tool.
[[nodiscard]] inline bool known_by_lines(const Tool& tool) {
  return (!tool.measured.empty() && !tool.fit) || tool.swap.has_value();
}

/// True of a tool that is swapped in at the robot's own modes: the robot is in its tip.
[[nodiscard]] inline bool swapped_on_robot(const Tool& tool) {
  return tool.swap && tool.swap->measured.empty();
}

}  // namespace thinwall::setup

namespace thinwall::core {

template <>
inline constexpr std::array<std::string_view, 4> words<setup::ToolEnd>{"flat", "ball", "bull_nose", "general"};
template <>
inline constexpr std::array<std::string_view, 4> words<setup::SwapRotations>{"none", "second_difference", "corrected",
                                                                             "rank_one"};

}  // namespace thinwall::core

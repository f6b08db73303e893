#pragma once
// The cut: engagement, force, feed; and the path that it takes along the part.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/words.hpp"

namespace thinwall::setup {

/// Laws of the cutting force over the chip thickness.
enum class ForceLawKind {
  linear,
  power,
  fractional,
  oblique,  ///< linear, with coefficients from orthogonal cutting
};

/// Orthogonal cutting data of a material, from turning: coefficients follow by the tool's helix.
struct OrthogonalData {
  std::optional<double> shear_stress;                             ///< Pa
  std::optional<double> shear_angle, friction_angle, rake_angle;  ///< rad
};

/// The cut: engagement, axes, force law and feed.
struct Cutting {
  std::optional<double> radial_depth;             ///< m; none: the angles are given
  std::vector<double> entry_angles, exit_angles;  ///< rad, one an arc
  bool down_milling = true;
  double lead_angle = 0.0;  ///< rad
  Eigen::Vector3d feed_direction = Eigen::Vector3d::UnitY();
  Eigen::Vector3d tool_axis = Eigen::Vector3d::UnitZ();
  std::string at;                          ///< name of the point that is cut
  double Kt = 0.0, Kr = 0.0, Ka = 0.0;     ///< N/m²
  double Kte = 0.0, Kre = 0.0, Kae = 0.0;  ///< N/m
  ForceLawKind law = ForceLawKind::linear;
  std::vector<double> exponents;                                 ///< of power: for Kt, Kr, Ka
  std::optional<double> chip_scale, stiffness_ratio;             ///< of fractional: m, 1
  OrthogonalData orthogonal;                                     ///< of oblique
  double process_damping = 0.0, process_damping_friction = 0.3;  ///< N/m, 1
  std::optional<double> spindle_speed_rpm;
  std::optional<double> feed_rate;       ///< m/s
  std::optional<double> feed_per_tooth;  ///< m
};

/// The path of the cut along the part, and the robot's behaviour meanwhile.
struct Path {
  std::vector<Eigen::Vector3d> positions;  ///< m, of the point that is cut, in order
  bool robot_follows = false;              ///< its contacts keep their distance to the cut; else they stay
};

}  // namespace thinwall::setup

namespace thinwall::core {

template <>
inline constexpr std::array<std::string_view, 4> words<setup::ForceLawKind>{"linear", "power", "fractional", "oblique"};

}  // namespace thinwall::core

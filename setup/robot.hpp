#pragma once
// The robot: one of the models of its tip, and how it stands.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/words.hpp"
#include "dynamics/modal_table.hpp"
#include "robot/serial_arm.hpp"
#include "robot/virtual_joints.hpp"
#include "setup/measured_frf.hpp"

namespace thinwall::setup {

/// Models of a robot's tip.
enum class RobotModel {
  one_mode,
  modes,
  measured,         ///< FRFs
  modal_table,      ///< a table of modes over postures
  flexible_joints,  ///< an arm with elastic joints
  virtual_joints,   ///< chains of links and elastic joints
};

/// A mode of a tip along a direction.
struct TipMode {
  double frequency_hz = 0.0, damping_ratio = 0.0, stiffness = 0.0;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
};

/// The posture that is asked of an arm: by its joints, or by the place of its tip (in the part's axes) with a pitch or
/// an approach.
struct PostureWish {
  std::vector<double> joints;               ///< rad; empty: by the place
  std::optional<Eigen::Vector3d> tip;       ///< m; none: the place of the first contact
  std::optional<double> pitch;              ///< rad
  bool elbow_up = true, ahead = true;       ///< of the postures for a pitch
  std::optional<Eigen::Vector3d> approach;  ///< unit vector
  double angle = 0.0;                       ///< rad, about it
  std::vector<double> start;                ///< rad; empty: zeros
};

/// The model of the robot's tip. `one_mode`: stiffness with frequency and damping ratio, or mass with stiffness and
/// damping (or damping ratio); what was not given is empty.
struct Robot {
  RobotModel model = RobotModel::one_mode;
  std::string point = "R";
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
  std::optional<double> frequency_hz, damping_ratio, mass, stiffness, damping;
  std::vector<TipMode> modes;
  std::vector<MeasuredFrf> measured;
  robot::SerialArm arm;              ///< world: the part's axes
  std::vector<robot::Chain> chains;  ///< of virtual_joints, world: the part's axes
  std::filesystem::path table;       ///< of modal_table
  std::string table_point, left_unit, right_unit;
  bool cross_terms = true;
  std::filesystem::path urdf, joints;  ///< that the arm was read from; empty: from the case
  PostureWish posture;
  Eigen::Vector3d preload = Eigen::Vector3d::Zero();             ///< N, on the tip
  std::vector<Eigen::Vector3d> workspace;                        ///< places of the tip, m
  std::vector<Sensor> sensors = {};                              ///< during all of `measured`
  std::shared_ptr<const dynamics::ModalTable> table_modes = {};  ///< of the table, once it is read
};

}  // namespace thinwall::setup

namespace thinwall::core {

template <>
inline constexpr std::array<std::string_view, 6> words<setup::RobotModel>{
    "one_mode", "modes", "measured", "modal_table", "flexible_joints", "virtual_joints"};

}  // namespace thinwall::core

#pragma once
// The robot: one of the models of its tip, and how it stands.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/words.hpp"
#include "dynamics/modal_table.hpp"
#include "robot/serial_arm.hpp"
#include "robot/virtual_joints.hpp"
#include "setup/measured_frf.hpp"

namespace thinwall::setup {

/// A mode of a tip along a direction.
struct TipMode {
  double frequency_hz = 0.0, damping_ratio = 0.0, stiffness = 0.0;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
};

/// The posture that is asked of an arm: by its joints, or by the place of its tip (in the part's axes) with a pitch or
/// an approach.
struct PostureWish {
  std::vector<double> joints;               ///< rad, of the joints that turn; empty: by the place
  std::optional<Eigen::Vector3d> tip;       ///< m; none: the place of the first contact
  std::optional<double> pitch;              ///< rad
  bool elbow_up = true, ahead = true;       ///< of the postures for a pitch
  std::optional<Eigen::Vector3d> approach;  ///< unit vector
  double angle = 0.0;                       ///< rad, about it
  std::vector<double> start;                ///< rad, of the joints that turn; empty: zeros
  std::vector<double> slides;               ///< m, of the joints that slide; empty: zeros
};

/// A tip of one mode: stiffness with frequency and damping ratio, or mass with stiffness and damping (or damping
/// ratio); what was not given is empty.
struct OneModeRobot {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
  std::optional<double> frequency_hz, damping_ratio, mass, stiffness, damping;
};

/// A tip that is the sum of modes, each along its own direction.
struct ModalRobot {
  std::vector<TipMode> modes;
};

/// A tip that is known by its FRFs.
struct MeasuredRobot {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< of a single FRF
  std::vector<MeasuredFrf> measured;
  std::vector<Sensor> sensors;  ///< during all of `measured`
};

/// An arm of rigid links with flexible joints, and the way in which it stands.
struct JointedRobot {
  robot::SerialArm arm;                ///< world: the part's axes
  std::filesystem::path urdf, joints;  ///< that the arm was read from; empty: from the case
  PostureWish posture;
  std::vector<Eigen::Vector3d> workspace;  ///< places of the tip, m
};

/// Postures at which a robot was tapped, and the one that is asked for.
struct TappedPostures {
  std::filesystem::path list;     ///< CSV with a column "posture" of names and others of numbers
  std::vector<std::string> over;  ///< the columns over which is learned: joint angles, places of the tip
  std::vector<double> at;         ///< of the posture that is asked for, as these columns have them
};

/// The content of the files of tapped postures, with the modes of each followed over all of them.
struct PostureTables {
  std::vector<std::string> names;  ///< of the postures
  Eigen::MatrixXd places;          ///< a row a posture: the columns over which is learned, as the list has them
  Eigen::MatrixXd joints;          ///< a row a posture: q of the arm that is the mean, rad (m); empty: none is
  std::vector<std::filesystem::path> files;  ///< of the tables
  std::vector<dynamics::ModalTable> tables;
  std::vector<std::vector<int>> labels;  ///< of each posture and mode: modes of one label are one mode of the robot
  int doubtful = 0;                      ///< labels that neighbours or another way contradict
  double freed_condition = 1.0;          ///< largest of TipTable, of the posture `freed_worst`
  std::string freed_worst{};
};

/// The uncertainty of modes that were learned.
struct LearnedPostures {
  std::string summary;                      ///< a sentence
  std::vector<dynamics::ModalTable> drawn;  ///< tables of modes that are as likely as the one that is expected
};

/// A second point of tables of modes, up the tool that was in the robot when it was tapped.
struct PointUp {
  std::string name;
  Eigen::Vector3d from_tip = Eigen::Vector3d::Zero();  ///< m, axes of the table
};

/// A tip that is known by a table of its modes, or by one at each of some postures.
struct TabledRobot {
  std::filesystem::path table;  ///< of postures with "{posture}" where the name of each is to stand
  std::string table_point, left_unit, right_unit;
  bool cross_terms = true;
  std::vector<Sensor> sensors = {};                        ///< while the table was tapped; points as it has them
  Eigen::Isometry3d base = Eigen::Isometry3d::Identity();  ///< whose axes are those of the table; world: the part's
  std::optional<TappedPostures> postures = {};             ///< none: the table is of the posture that is asked for
  std::optional<JointedRobot> mean = {};  ///< of `postures`: an arm whose modes, once it is calibrated, are the mean of
                                          ///< what is learned; its posture is the one that is asked for
  std::vector<std::string> joint_columns =
      {};  ///< of the list: q of the joints of `mean`, rad (m); "0": it stands still
  std::shared_ptr<const PostureTables> tapped = {};  ///< of `postures`, once they are read
  std::shared_ptr<const dynamics::ModalTable> table_modes =
      {};                                               ///< of the table once it is read, or learned of `tapped`
  std::shared_ptr<const LearnedPostures> learned = {};  ///< beside learned ones
  std::optional<PointUp> up = {};  ///< learned with the tip, both across the tool, for another tool in its place
                                   ///< (ToolSwap); none: the tip alone
};

/// Chains of links and elastic joints that hold one tip.
struct ChainedRobot {
  std::vector<robot::Chain> chains;  ///< world: the part's axes
};

/// A model of a robot's tip.
using RobotModel = std::variant<OneModeRobot, ModalRobot, MeasuredRobot, TabledRobot, JointedRobot, ChainedRobot>;

/// The models of a robot's tip, in the order of RobotModel.
enum class RobotKind { one_mode, modes, measured, modal_table, flexible_joints, virtual_joints };

/// The two uses of a robot: it supports the part, or it carries the tool.
enum class RobotCarries { part, tool };

/// The robot: its tip's name, what presses it, the model of it, and its use.
struct Robot {
  std::string point = "R";
  Eigen::Vector3d preload = Eigen::Vector3d::Zero();  ///< N, on the tip
  RobotModel model;
  RobotCarries carries = RobotCarries::part;
  std::string cut_point{};  ///< of a robot that carries the tool: the point of the part that is cut; empty: not known
};

/// True if there is a robot whose tip is the tool's.
[[nodiscard]] inline bool carries_tool(const std::optional<Robot>& robot) {
  return robot && robot->carries == RobotCarries::tool;
}

/// The robot of a table of modes, or of tables at postures; null for another one, and where there is none.
[[nodiscard]] inline const TabledRobot* tabled_robot(const std::optional<Robot>& robot) {
  return robot ? std::get_if<TabledRobot>(&robot->model) : nullptr;
}
/// The robot of a set-up that may change.
[[nodiscard]] inline TabledRobot* tabled_robot(std::optional<Robot>& robot) {
  return robot ? std::get_if<TabledRobot>(&robot->model) : nullptr;
}

/// The kind of a robot's model.
[[nodiscard]] inline RobotKind kind(const Robot& robot) {
  return static_cast<RobotKind>(robot.model.index());
}

/// True if the robot is known by measurements alone: FRFs, or a table of modes. Such a robot has no matrices.
[[nodiscard]] inline bool is_measured(const Robot& robot) {
  return std::holds_alternative<MeasuredRobot>(robot.model) || std::holds_alternative<TabledRobot>(robot.model);
}

}  // namespace thinwall::setup

namespace thinwall::core {

template <>
inline constexpr std::array<std::string_view, 2> words<setup::RobotCarries>{"part", "tool"};
template <>
inline constexpr std::array<std::string_view, 6> words<setup::RobotKind>{
    "one_mode", "modes", "measured", "modal_table", "flexible_joints", "virtual_joints"};

}  // namespace thinwall::core

#pragma once
// The robot as the case knows it: how it stands, and its tip as the coupling sees it.

#include <optional>

#include "robot/one_mode.hpp"
#include "robot/tip_model.hpp"
#include "setup/machining_setup.hpp"

namespace thinwall::setup {

/// The posture of the robot; what an arm's joints tell is empty for other models.
struct RobotPosture {
  robot::Posture posture;
  std::vector<bool> slides;                 ///< true of the joints whose q is a distance, m
  std::optional<Eigen::Vector3d> tip;       ///< m, part axes
  std::optional<double> smallest_singular;  ///< of the tip's Jacobian, 1 m a radian, over its largest
  std::vector<Eigen::Vector3d> arm;         ///< from joint to joint to the tip, m, part axes
};

/// The point of the part at which the robot's tip belongs: that of the first contact, or the one that is cut where the
/// robot carries the tool; empty if there is none.
[[nodiscard]] std::string tip_point(const SupportSetup& support);

/// The place of that point, in space, m; none without it or without a modelled part.
[[nodiscard]] std::optional<Eigen::Vector3d> tip_place(const PartSetup& part, const SupportSetup& support);

/// The modes of a robot's tip or a tool's, as the case lists them. Errors as robot::one_mode().
[[nodiscard]] std::vector<robot::OneMode> one_modes(const std::vector<TipMode>& list);

/// Reads the file that robot.table names, or those of all postures (read_posture_tables()). Errors as
/// read_tip_table() or read_posture_tables().
void read_table_of_modes(TabledRobot& robot);

/// The tip at any posture, by the model that the case names. Measured receptances are put on `axis`. Throws InputError
/// for a table of modes or an FRF that was not read, or modes that were not learned (identify()).
[[nodiscard]] robot::TipModel tip_model(const Robot& robot, const dynamics::FrequencyAxis& axis);

/// The joints q (rad, m) of an arm in the posture that is asked of it, as robot_posture() has them. Errors as that
/// does.
[[nodiscard]] Eigen::VectorXd wished_joints(const PartSetup& part, const SupportSetup& support,
                                            const JointedRobot& robot);

/// The posture of the set-up's robot: its joints by the case's word, or by inverse kinematics for the place of its tip,
/// from `near` on where a search is needed. For a model without posture only the preload is told. Throws InputError for
/// a place out of reach, an arm that the closed form is not for, a search that ends beside the place.
[[nodiscard]] RobotPosture robot_posture(const PartSetup& part, const SupportSetup& support,
                                         const std::optional<Eigen::VectorXd>& near = {});

/// The robot's matrices in that posture. Throws InputError for a robot that has none.
[[nodiscard]] dynamics::SpatialModel robot_matrices(const Robot& robot, const robot::Posture& posture);

/// The robot's matrices in the posture that the set-up asks for. Errors as the other, and as robot_posture().
[[nodiscard]] dynamics::SpatialModel robot_matrices(const PartSetup& part, const SupportSetup& support);

}  // namespace thinwall::setup

#include "setup/robot_tip.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "core/messages.hpp"
#include "core/overloaded.hpp"
#include "dynamics/conversion.hpp"
#include "io/frf/resample.hpp"
#include "robot/arm_kinematics.hpp"
#include "robot/flexible_joints.hpp"
#include "robot/inverse_kinematics.hpp"
#include "robot/measured.hpp"
#include "robot/modal_table.hpp"
#include "robot/one_mode.hpp"
#include "setup/identified/posture_tables.hpp"
#include "setup/measured.hpp"
#include "setup/part_geometry.hpp"
#include "setup/sensor_mass.hpp"

namespace thinwall::setup {

namespace {

using Eigen::Vector3d;

robot::OneMode single_mode(const OneModeRobot& robot) {
  const double k = *robot.stiffness;
  if (!robot.mass) {
    robot::OneMode mode = robot::one_mode(*robot.frequency_hz, robot.damping_ratio.value_or(0.0), k, robot.direction);
    if (robot.damping) mode.damping = *robot.damping;
    return mode;
  }
  const double c =
      robot.damping ? *robot.damping : 2.0 * robot.damping_ratio.value_or(0.0) * std::sqrt(k * *robot.mass);
  return {*robot.mass, c, k, robot.direction};
}

/// One file is along robot.direction, several are between the tip's axes; less the sensors.
dynamics::ResponseModel measured_tip(const MeasuredRobot& robot, const std::string& point,
                                     const dynamics::FrequencyAxis& axis) {
  dynamics::ResponseModel tip =
      robot.measured.size() > 1
          ? measured_response(robot.measured, axis)
          : robot::measured_receptance(axis, io::resample(receptance_of(robot.measured.front()), axis), point,
                                       robot.direction);
  return without_sensors(std::move(tip), robot.sensors, "the robot's");
}

/// The tip's part of the table, its axes turned into the part's.
dynamics::ModalModel tabled_tip(const TabledRobot& robot, const std::string& point) {
  if (!robot.table_modes)
    throw core::InputError("\"" + robot.table.string() + "\" " +
                           (robot.tapped ? "was not learned from; call setup::identify()"
                                         : "was not read; call setup::read_data_files()"));
  dynamics::ModalModel tip = robot::modal_model(robot::at_point(*robot.table_modes, robot.table_point));
  if (!robot.cross_terms) tip = robot::without_cross_terms(tip);
  for (dynamics::Dof& dof : tip.dofs) {
    dof.point = point;
    dof.direction = robot.base.linear() * dof.direction;
  }
  return tip;
}

/// The place in space where the tip is to be.
Vector3d wanted_place(const PartSetup& part, const SupportSetup& support, const PostureWish& wish) {
  if (wish.tip) return *wish.tip;
  if (const auto place = tip_place(part, support)) return *place;
  throw core::InputError(std::string("the place of the robot's tip is not known; give robot.posture.tip or ") +
                         (carries_tool(support.robot) ? "cutting.at" : "a contact"));
}

/// The closed form's posture on the wanted side and with the wanted elbow.
Eigen::VectorXd four_axis_posture(const JointedRobot& robot, const Vector3d& place) {
  const PostureWish& wish = robot.posture;
  const Vector3d p = robot.arm.base.inverse() * place;
  const double towards = std::atan2(p.y(), p.x());
  for (const Eigen::Vector4d& q : robot::four_axis_postures(robot.arm, place, *wish.pitch)) {
    const bool ahead = std::cos(q(0) - towards) >= 0.0;
    if (ahead == wish.ahead && (q(2) >= 0.0) == wish.elbow_up) return q;
  }
  throw core::InputError(fmt::format("the place is reached with another elbow or facing only than \"{}\" and \"{}\"",
                                     wish.elbow_up ? "up" : "down", wish.ahead ? "ahead" : "behind"));
}

/// z along the approach; x in the plane of it and the base's z, towards z, then turned by the angle.
Eigen::Isometry3d tip_frame(const JointedRobot& robot, const Vector3d& place) {
  const Vector3d z = *robot.posture.approach;
  const Eigen::Matrix3d base = robot.arm.base.linear();
  Vector3d x = base.col(2) - base.col(2).dot(z) * z;
  if (x.norm() < 1e-6) x = base.col(0) - base.col(0).dot(z) * z;  // approached along the base's axis
  x.normalize();
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear() << x, z.cross(x), z;
  frame.linear() = Eigen::AngleAxisd(robot.posture.angle, z) * frame.linear();
  frame.translation() = place;
  return frame;
}

Eigen::VectorXd searched_posture(const JointedRobot& robot, const Vector3d& place, const Eigen::VectorXd& start) {
  const robot::Reached found = robot::reach(robot.arm, tip_frame(robot, place), start);
  if (found.status != robot::ReachStatus::not_reached) return found.q;
  throw core::InputError(fmt::format(
      "the robot does not reach ({:.4g}, {:.4g}, {:.4g}) m: the search ends {:.3g} m and {:.3g} deg beside it; move "
      "the "
      "base, choose another approach or angle, or another start",
      place.x(), place.y(), place.z(), found.position_error, found.rotation_error * 180.0 / std::numbers::pi));
}

/// The angles of joints that turn and the distances of those that slide, in the order of the joints; an empty list is
/// one of zeros.
Eigen::VectorXd in_order(const robot::SerialArm& arm, const std::vector<double>& angles,
                         const std::vector<double>& distances) {
  Eigen::VectorXd q = Eigen::VectorXd::Zero(arm.joints());
  std::size_t turned = 0, slid = 0;
  for (Eigen::Index i = 0; i < arm.joints(); ++i) {
    const bool slides = arm.links[static_cast<std::size_t>(i)].slides;
    const std::vector<double>& list = slides ? distances : angles;
    std::size_t& next = slides ? slid : turned;
    if (next < list.size()) q(i) = list[next++];
  }
  return q;
}

Eigen::VectorXd joints_of(const PartSetup& part, const SupportSetup& support, const JointedRobot& robot,
                          const std::optional<Eigen::VectorXd>& near) {
  const PostureWish& wish = robot.posture;
  const bool by_slides = !wish.slides.empty() && !wish.pitch && !wish.approach;
  if (!wish.joints.empty() || by_slides) return in_order(robot.arm, wish.joints, wish.slides);
  if (wish.pitch) return four_axis_posture(robot, wanted_place(part, support, wish));
  if (!wish.approach)
    throw core::InputError("how the robot stands is not known; give robot.posture by joints, pitch or approach");
  const Eigen::VectorXd start = in_order(robot.arm, wish.start, wish.slides);
  return searched_posture(robot, wanted_place(part, support, wish), near.value_or(start));
}

/// The ratio of the smallest to the largest singular value of the tip's Jacobian with 1 m a radian.
double smallest_singular(const robot::ArmPose& at) {
  const Eigen::VectorXd s = Eigen::JacobiSVD<Eigen::MatrixXd>(robot::tip_jacobian(at)).singularValues();
  return s(s.size() - 1) / s(0);
}

}  // namespace

std::string tip_point(const SupportSetup& support) {
  if (carries_tool(support.robot)) return support.robot->cut_point;
  return support.contacts.empty() ? "" : support.contacts.front().part_point;
}

std::optional<Vector3d> tip_place(const PartSetup& part, const SupportSetup& support) {
  const std::string name = tip_point(support);
  if (name.empty() || !part.part) return std::nullopt;
  const Vector3d flat = position(*part.part, point(part, name));
  if (!flat.allFinite()) return std::nullopt;  // a node of matrices whose place no file tells
  return bend(*part.part) != nullptr ? mesh::bent(bend_of(*part.part), flat) : flat;
}

std::vector<robot::OneMode> one_modes(const std::vector<TipMode>& list) {
  std::vector<robot::OneMode> modes;
  modes.reserve(list.size());
  for (const TipMode& m : list)
    modes.push_back(robot::one_mode(m.frequency_hz, m.damping_ratio, m.stiffness, m.direction));
  return modes;
}

void read_table_of_modes(TabledRobot& robot) {
  if (robot.postures) {
    robot.tapped = std::make_shared<const PostureTables>(read_posture_tables(robot));
    return;
  }
  TipTable tip = read_tip_table(robot.table, robot);
  if (const std::string doubt = doubt_about_sensors(tip.condition, "in " + robot.table.string()); !doubt.empty())
    core::warn(doubt);
  robot.table_modes = std::make_shared<const dynamics::ModalTable>(std::move(tip.table));
}

robot::TipModel tip_model(const Robot& robot, const dynamics::FrequencyAxis& axis) {
  const std::string& point = robot.point;
  const auto of_modes = [&](const std::vector<robot::OneMode>& modes) {
    return robot::in_one_posture(robot::spatial_model(modes, point));
  };
  return std::visit(
      core::overloaded{
          [&](const OneModeRobot& model) { return of_modes({single_mode(model)}); },
          [&](const ModalRobot& model) { return of_modes(one_modes(model.modes)); },
          [&](const MeasuredRobot& model) { return robot::in_one_posture(measured_tip(model, point, axis)); },
          [&](const TabledRobot& model) { return robot::in_one_posture(tabled_tip(model, point)); },
          [&](const JointedRobot& model) { return robot::flexible_joints(model.arm, point); },
          [&](const ChainedRobot& model) {
            return robot::in_one_posture(robot::spatial_model(robot::reduced_tip(model.chains), point));
          }},
      robot.model);
}

Eigen::VectorXd wished_joints(const PartSetup& part, const SupportSetup& support, const JointedRobot& robot) {
  return joints_of(part, support, robot, std::nullopt);
}

RobotPosture robot_posture(const PartSetup& part, const SupportSetup& support,
                           const std::optional<Eigen::VectorXd>& near) {
  RobotPosture result;
  result.posture.preload = support.robot->preload;
  const auto* robot = std::get_if<JointedRobot>(&support.robot->model);
  if (robot == nullptr) return result;
  result.posture.q = joints_of(part, support, *robot, near);
  const robot::ArmPose at = robot::pose(robot->arm, result.posture.q);
  result.tip = at.tip.translation();
  result.slides = at.slides;
  result.smallest_singular = smallest_singular(at);
  for (const auto& origin : at.origins.colwise()) result.arm.emplace_back(origin);
  result.arm.push_back(*result.tip);
  return result;
}

dynamics::SpatialModel robot_matrices(const Robot& robot, const robot::Posture& posture) {
  if (!is_measured(robot)) {
    robot::Tip tip = tip_model(robot, {})(posture);
    if (auto* spatial = std::get_if<dynamics::SpatialModel>(&tip)) return std::move(*spatial);
  }
  throw core::InputError("robot.model = \"" + core::word_of(kind(robot)) + "\" has no matrices; take a modelled robot");
}

dynamics::SpatialModel robot_matrices(const PartSetup& part, const SupportSetup& support) {
  return robot_matrices(*support.robot, robot_posture(part, support).posture);
}

}  // namespace thinwall::setup

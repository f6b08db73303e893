#include "case/robot_binding.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "case/joint_binding.hpp"
#include "case/measured_binding.hpp"
#include "core/error.hpp"

namespace thinwall::cases {

namespace {

/// Turned about x, then y, then z of the frame before.
Eigen::Isometry3d bind_frame(const Table& table) {
  const Eigen::Vector3d turn = table.vector("rotation");
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear() =
      (Eigen::AngleAxisd(turn.z(), Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(turn.y(), Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(turn.x(), Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  frame.translation() = table.vector("position");
  return frame;
}

/// xx, yy, zz, or these and xy, xz, yz; NaN for another number of them.
Eigen::Matrix3d bind_inertia(const std::vector<double>& list) {
  Eigen::Matrix3d I = Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN());
  if (list.size() != 3 && list.size() != 6) return I;
  I = Eigen::Vector3d(list[0], list[1], list[2]).asDiagonal();
  if (list.size() == 3) return I;
  I(0, 1) = I(1, 0) = list[3];
  I(0, 2) = I(2, 0) = list[4];
  I(1, 2) = I(2, 1) = list[5];
  return I;
}

robot::Link bind_link(const Table& table) {
  robot::Link link;
  link.name = table.text("name");
  link.placement = bind_frame(table);
  link.axis = table.direction("axis");
  link.joint = bind_joint(table);
  link.mass = table.number("mass");
  link.centre = table.vector("centre");
  link.inertia = bind_inertia(table.numbers("inertia"));
  return link;
}

/// Number of the link of that name, −1 of the base; beyond them all if there is none.
int link_number(const std::string& name, const std::vector<robot::Link>& links) {
  if (name == "base") return -1;
  return static_cast<int>(std::ranges::find(links, name, &robot::Link::name) - links.begin());
}

/// The place and the orientation of the robot's base, in the part's axes.
Eigen::Isometry3d bind_base(const Table& robot) {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  const Table base = robot.table("base");
  if (!base.exists()) return frame;
  const Eigen::Vector3d x = base.direction("x"), z = base.direction("z");
  frame.linear() << x, z.cross(x), z;
  frame.translation() = base.vector("position");
  return frame;
}

/// Counterbalances, base and gravity: what the case tells of an arm wherever its links come from.
void bind_surroundings(const Table& table, robot::SerialArm& arm) {
  for (const Table& spring : table.tables("counterbalances")) {
    arm.counterbalances.push_back({link_number(spring.text("from"), arm.links), spring.vector("from_point"),
                                   link_number(spring.text("to"), arm.links), spring.vector("to_point"),
                                   spring.number("force"), spring.number("length"), spring.number("stiffness")});
  }
  arm.base = bind_base(table);
  if (const Table tip = table.table("tip"); tip.exists()) arm.tip = arm.tip * bind_frame(tip);
  arm.gravity = table.has("gravity") ? table.vector("gravity") : Eigen::Vector3d(-9.81 * arm.base.linear().col(2));
}

robot::SerialArm bind_arm(const Table& table) {
  robot::SerialArm arm;
  if (table.has("urdf")) return arm;  // its links are read later (case/data_files.hpp)
  for (const Table& link : table.tables("links")) arm.links.push_back(bind_link(link));
  bind_surroundings(table, arm);
  return arm;
}

robot::ChainElement bind_element(const Table& table) {
  const std::string kind = table.text("kind");
  if (kind == "offset") return robot::RigidLink{bind_frame(table)};
  if (kind == "body")
    return dynamics::RigidBody{table.number("mass"), table.vector("centre"), bind_inertia(table.numbers("inertia"))};
  if (kind == "beam") {
    const dynamics::Tube tube{table.number("outer_diameter"), table.number("inner_diameter"),
                              table.number("youngs_modulus"), table.number("poisson_ratio"), table.number("density")};
    return robot::BeamLink{dynamics::section(tube), table.number("length")};
  }
  const bool turns = kind == "rotation";
  return robot::VirtualJoint{turns ? robot::VirtualJoint::Motion::rotation : robot::VirtualJoint::Motion::translation,
                             table.direction("axis"), table.number(turns ? "angle" : "distance"),
                             table.optional(turns ? "stiffness" : "linear_stiffness").value_or(0.0),
                             table.number(turns ? "damping" : "linear_damping")};
}

setup::PostureWish bind_posture(const Table& table) {
  setup::PostureWish wish;
  if (!table.exists()) return wish;
  wish.joints = table.numbers("joints");
  if (table.has("tip")) wish.tip = table.vector("tip");
  wish.pitch = table.optional("pitch");
  wish.elbow_up = table.text("elbow") != "down";
  wish.ahead = table.text("facing") != "behind";
  if (table.has("approach")) wish.approach = table.direction("approach");
  wish.angle = table.number("angle");
  wish.start = table.numbers("start");
  wish.slides = table.numbers("slides");
  return wish;
}

/// The places of the grid, x fastest; none where it could not be read.
std::vector<Eigen::Vector3d> bind_workspace(const Table& table) {
  std::vector<Eigen::Vector3d> places;
  if (!table.exists()) return places;
  const Eigen::Vector3d from = table.vector("from"), to = table.vector("to"), counts = table.vector("counts");
  if (!counts.allFinite() || !from.allFinite() || !to.allFinite()) return places;
  const auto at = [&](int axis, double i) {
    return counts[axis] > 1.5 ? from[axis] + (to[axis] - from[axis]) * i / (std::round(counts[axis]) - 1.0)
                              : from[axis];
  };
  for (int k = 0; k < std::lround(counts.z()); ++k) {
    for (int j = 0; j < std::lround(counts.y()); ++j) {
      for (int i = 0; i < std::lround(counts.x()); ++i) places.emplace_back(at(0, i), at(1, j), at(2, k));
    }
  }
  return places;
}

}  // namespace

robot::SerialArm arm_in_place(const Table& robot, robot::SerialArm arm) {
  bind_surroundings(robot, arm);
  return arm;
}

std::vector<robot::Chain> bind_chains(const Table& robot) {
  std::vector<robot::Chain> chains;
  const Eigen::Isometry3d base = bind_base(robot);
  for (const Table& element : robot.tables("elements")) {
    const auto number = static_cast<std::size_t>(std::max(element.integer("chain"), 1));
    while (chains.size() < number) chains.push_back({base, {}});
    chains[number - 1].elements.push_back(bind_element(element));
  }
  return chains;
}

std::vector<setup::TipMode> bind_modes(const std::vector<Table>& tables) {
  std::vector<setup::TipMode> modes;
  modes.reserve(tables.size());
  for (const Table& mode : tables) {
    modes.push_back({mode.number("frequency"), mode.number("damping_ratio"), mode.number("stiffness"),
                     mode.direction("direction")});
  }
  return modes;
}

namespace {

std::filesystem::path file_of(const Table& table, const char* key, const std::filesystem::path& folder) {
  return table.has(key) ? folder / table.text(key) : std::filesystem::path();
}

/// The chains; none where a beam has no section, which the checks tell: they bind the chains once more.
std::vector<robot::Chain> chains_or_none(const Table& table) {
  try {
    return bind_chains(table);
  } catch (const core::InputError&) {
    return {};
  }
}

std::optional<setup::TappedPostures> bind_postures(const Table& table, const std::filesystem::path& folder) {
  if (!table.has("postures")) return std::nullopt;
  return setup::TappedPostures{file_of(table, "postures", folder), table.names("over"), table.numbers("at")};
}

setup::JointedRobot bind_jointed(const Table& table, const std::filesystem::path& folder) {
  return {bind_arm(table), file_of(table, "urdf", folder), file_of(table, "joints", folder),
          bind_posture(table.table("posture")), bind_workspace(table.table("workspace"))};
}

/// The arm that is the mean of modes over postures, where the case has one.
std::optional<setup::JointedRobot> bind_mean(const Table& table, const std::filesystem::path& folder) {
  if (!table.has("urdf") && table.tables("links").empty()) return std::nullopt;
  return bind_jointed(table, folder);
}

setup::RobotModel bind_model(const Table& table, const std::filesystem::path& folder) {
  switch (table.choice<setup::RobotKind>("model")) {
    case setup::RobotKind::one_mode:
      break;
    case setup::RobotKind::modes:
      return setup::ModalRobot{bind_modes(table.tables("modes"))};
    case setup::RobotKind::measured:
      return setup::MeasuredRobot{table.direction("direction"), bind_all_measured(table.tables("measured"), folder),
                                  bind_sensors(table.tables("sensors"))};
    case setup::RobotKind::modal_table:
      return setup::TabledRobot{file_of(table, "table", folder),
                                table.text("table_point"),
                                table.text("left_unit"),
                                table.text("right_unit"),
                                table.flag("cross_terms"),
                                bind_sensors(table.tables("sensors")),
                                bind_base(table),
                                bind_postures(table, folder),
                                bind_mean(table, folder),
                                table.names("joint_columns"),
                                {},
                                {},
                                {}};
    case setup::RobotKind::flexible_joints:
      return bind_jointed(table, folder);
    case setup::RobotKind::virtual_joints:
      return setup::ChainedRobot{chains_or_none(table)};
  }
  return setup::OneModeRobot{table.direction("direction"), table.optional("frequency"), table.optional("damping_ratio"),
                             table.optional("mass"),       table.optional("stiffness"), table.optional("damping")};
}

}  // namespace

setup::Robot bind_robot(const Table& table, const std::filesystem::path& folder) {
  return {table.text("point"), table.vector("preload"), bind_model(table, folder),
          table.choice<setup::RobotCarries>("carries")};
}

}  // namespace thinwall::cases

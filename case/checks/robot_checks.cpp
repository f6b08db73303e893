#include "case/checks/robot_checks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "case/checks/measured_checks.hpp"
#include "case/checks/part_checks.hpp"
#include "case/robot_binding.hpp"
#include "case/schema/schema.hpp"
#include "core/error.hpp"
#include "core/overloaded.hpp"
#include "robot/flexible_joints.hpp"
#include "setup/identified/arm_mean.hpp"
#include "setup/identified/posture_tables.hpp"
#include "setup/measured_layout.hpp"
#include "setup/robot_tip.hpp"

namespace thinwall::cases {

namespace {

void check_one_mode(const setup::OneModeRobot& robot, Findings& findings) {
  if (robot.mass.has_value() == robot.frequency_hz.has_value()) {
    findings.report("robot.frequency", "give either frequency or mass beside the stiffness");
  }
  if (robot.damping.has_value() == robot.damping_ratio.has_value()) {
    findings.report("robot.damping_ratio", "give either damping_ratio or damping");
  }
  if (!robot.mass || !robot.stiffness || !(*robot.mass > 0.0) || !std::isfinite(*robot.stiffness)) return;
  try {
    require_within_bounds(*find_key(case_schema(), "robot.frequency"),
                          std::sqrt(*robot.stiffness / *robot.mass) / (2.0 * std::numbers::pi));
  } catch (const core::InputError& error) {
    findings.report("robot.mass", "beside robot.stiffness it cannot be: " + std::string(error.what()));
  }
}

/// One file is a driving point along robot.direction; several name the tip's axes.
void check_measured_robot(const setup::MeasuredRobot& robot, const std::string& point, Findings& findings) {
  if (robot.measured.empty()) return;
  check_sensors("robot.sensors", robot.sensors, {point}, findings);
  if (robot.measured.size() > 1) {
    check_layout("robot.measured", robot.measured, findings);
    return;
  }
  const setup::MeasuredFrf& frf = robot.measured.front();
  if (!frf.response.empty() && !frf.force.empty() && frf.response != frf.force) {
    findings.report("robot.measured[0].force",
                    "\"" + frf.force + "\" is not the DOF that moves; a single file is a driving point, force = \"" +
                        frf.response + "\"");
  }
  const auto measured_along = direction_of(frf.response);
  if (!measured_along || setup::point_of(frf.response) != point) return;
  for (const auto* letter : {"x", "y", "z"}) {
    const Eigen::Vector3d axis = *direction_of(point + "." + letter);
    if ((robot.direction - axis).norm() < 1e-9 && *measured_along != axis)
      findings.report("robot.measured[0].response",
                      "\"" + frf.response + "\" is not along robot.direction; give \"" + point + "." + letter + "\"");
  }
}

bool all_read(const robot::SerialArm& arm) {
  const bool springs = std::ranges::all_of(arm.counterbalances, [](const robot::Counterbalance& s) {
    return s.from_point.allFinite() && s.to_point.allFinite() && std::isfinite(s.length);
  });
  return springs && arm.base.matrix().allFinite() && arm.gravity.allFinite() &&
         std::ranges::all_of(arm.links, [](const robot::Link& link) {
           return std::isfinite(link.mass) && std::isfinite(link.joint.stiffness) && link.centre.allFinite() &&
                  link.axis.allFinite() && link.placement.matrix().allFinite();
         });
}

void check_counterbalances(const robot::SerialArm& arm, Findings& findings) {
  std::vector<std::string> known{"base"};
  for (const robot::Link& link : arm.links) {
    if (!link.name.empty()) known.push_back(link.name);
  }
  for (std::size_t i = 0; i < arm.counterbalances.size(); ++i) {
    const std::string table = "robot.counterbalances[" + std::to_string(i) + "]";
    for (const char* end : {".from", ".to"}) {
      const CaseValue* name = find(findings.values, table + end);
      if (name != nullptr) findings.require_known(table + end, std::get<std::string>(name->value), known, "link");
    }
  }
}

/// Checks that a list, where it is given, has a number for each of the joints that it is for.
void require_one_each(const std::string& key, std::size_t given, const std::string& numbers, std::size_t joints,
                      const std::string& motion, Findings& findings) {
  if (!findings.given(key) || given == joints) return;
  findings.report(key, std::to_string(given) + " " + numbers + " for " + std::to_string(joints) + " joints that " +
                           motion + "; give one for each");
}

/// Checks the posture that is asked of the arm.
void check_posture_keys(const setup::JointedRobot& robot, Findings& findings) {
  const setup::PostureWish& wish = robot.posture;
  const bool by_slides = findings.given("robot.posture.slides") && !wish.pitch && !wish.approach;
  const int ways =
      (findings.given("robot.posture.joints") || by_slides ? 1 : 0) + (wish.pitch ? 1 : 0) + (wish.approach ? 1 : 0);
  if (ways != 1) {
    findings.report("robot.posture", "give either joints, or pitch (four-axis arms), or approach (any arm)");
    return;
  }
  const CaseValue* counts = find(findings.values, "robot.workspace.counts");
  if (counts != nullptr && std::get<std::vector<double>>(counts->value).size() != 3)
    findings.report("robot.workspace.counts", "must be three numbers, along x, y, z");
  if (counts != nullptr && !wish.joints.empty())
    findings.report("robot.workspace", "needs a posture by pitch or approach; joints hold the arm in one place");
  const auto sliding = static_cast<std::size_t>(std::ranges::count(robot.arm.links, true, &robot::Link::slides));
  const std::size_t turning = robot.arm.links.size() - sliding;
  require_one_each("robot.posture.joints", wish.joints.size(), "angles", turning, "turn", findings);
  require_one_each("robot.posture.start", wish.start.size(), "angles", turning, "turn", findings);
  require_one_each("robot.posture.slides", wish.slides.size(), "distances", sliding, "slide", findings);
}

/// True if the arm was read; a fault of its files was reported when they were.
bool check_urdf(const Case& source, const setup::JointedRobot& robot, Findings& findings) {
  if (array_size(source.values, "robot.links") > 0) {
    findings.report("robot.urdf", "an arm's links are in the case or in a URDF, not in both; remove one");
    return false;
  }
  if (robot.joints.empty()) {
    findings.report("robot.urdf", "needs robot.joints: a file with the stiffness of each joint, which no URDF tells");
    return false;
  }
  return source.urdf_arm != nullptr;
}

/// Checks the links of an arm and how it is to stand; true if it is one.
bool is_arm(const Case& source, const setup::JointedRobot& robot, bool posture_given, Findings& findings) {
  const std::size_t before = findings.problems.size();
  check_counterbalances(robot.arm, findings);
  for (std::size_t i = 0; i < robot.arm.links.size(); ++i) {
    const std::string key = "robot.links[" + std::to_string(i) + "].inertia";
    const CaseValue* inertia = find(source.values, key);
    const auto* list = inertia == nullptr ? nullptr : std::get_if<std::vector<double>>(&inertia->value);
    if (list != nullptr && !list->empty() && list->size() != 3 && list->size() != 6)
      findings.report(key, "must have three moments, xx, yy, zz, or these and xy, xz, yz");
  }
  if (posture_given) check_posture_keys(robot, findings);
  if (findings.problems.size() > before || !all_read(robot.arm)) return false;
  try {
    robot::require_valid(robot.arm);
  } catch (const core::InputError& error) {
    findings.report("robot.links", error.what());
    return false;
  }
  return true;
}

void check_arm(const Case& source, const setup::JointedRobot& robot, Findings& findings) {
  if (!robot.urdf.empty()) {
    if (!check_urdf(source, robot, findings)) return;
  } else if (robot.arm.links.empty()) {
    findings.report("robot.model", "flexible_joints needs [[robot.links]], from the base to the tip, or robot.urdf");
    return;
  }
  if (!is_arm(source, robot, true, findings)) return;
  // Places of a workspace that are not reached are told by the survey; those of a coupling or a cut must be.
  const bool surveyed_only = source.contacts.empty() && !setup::carries_tool(source.robot) && !robot.posture.tip;
  if (!robot.workspace.empty() && surveyed_only) return;
  std::optional<Eigen::VectorXd> near;
  if (const std::string fault = fault_of_posture(source, source, near); !fault.empty())
    findings.report("robot.posture", fault);
}

/// Checks an arm that is the mean of modes over postures.
void check_mean(const Case& source, const setup::TabledRobot& tabled, Findings& findings) {
  if (!tabled.mean) {
    const Table keys{source.values, "robot"};
    for (const char* key : {"joint_columns", "gravity", "posture", "tip"}) {
      if (keys.has(key) || keys.table(key).exists())
        findings.report(
            std::string("robot.") + key,
            "is of an arm that is the mean of modes over postures; give its [[robot.links]] or robot.urdf, or "
            "remove it");
    }
    return;
  }
  if (!tabled.postures)
    return findings.report("robot.links",
                           "an arm beside a table is the mean of its modes over robot.postures; give "
                           "those, or remove the arm");
  if (!tabled.mean->urdf.empty() && !check_urdf(source, *tabled.mean, findings)) return;
  if (!is_arm(source, *tabled.mean, Table{source.values, "robot.posture"}.exists(), findings)) return;
  const std::size_t columns = tabled.joint_columns.size(), links = tabled.mean->arm.links.size();
  if (columns != links)
    return findings.report("robot.joint_columns",
                           "names " + std::to_string(columns) + " columns of robot.postures for the " +
                               std::to_string(links) +
                               " joints of the arm; give one for each, \"0\" if it stands still");
  for (const robot::Link& link : tabled.mean->arm.links) {
    if (!(link.joint.damping > 0.0))
      findings.report("robot.links", "\"" + link.name +
                                         "\" has no damping, must be above 0 for the calibration on "
                                         "postures; give it a first guess");
  }
  if (!tabled.tapped || setup::joints_from_columns(tabled).size() > 0) return;
  try {
    (void)setup::wished_joints(source, source, *tabled.mean);
  } catch (const core::InputError& error) {
    findings.report("robot.posture", error.what());
  }
}

/// The robot; one that is to be learned with the modes of its first posture.
setup::Robot before_learning(setup::Robot robot) {
  if (auto* tabled = std::get_if<setup::TabledRobot>(&robot.model)) *tabled = setup::as_first_posture(*tabled);
  return robot;
}

void check_table(const setup::Robot& robot, const setup::TabledRobot& tabled, Findings& findings) {
  if (!tabled.table_modes && !tabled.tapped) return;  // a fault of the file was reported when it was read
  try {
    (void)setup::tip_model(before_learning(robot), {});
  } catch (const core::Error& error) {
    findings.report("robot.table", error.what());
  }
}

void check_elements(const Case& source, Findings& findings) {
  const int count = array_size(source.values, "robot.elements");
  const auto of_elements = [](const Problem& problem) { return problem.text.starts_with("robot.elements"); };
  if (count == 0 || std::ranges::any_of(findings.problems, of_elements)) return;
  try {
    const auto chains = bind_chains({source.values, "robot"});
    (void)robot::spatial_model(robot::reduced_tip(chains), source.robot->point);
  } catch (const core::InputError& error) {
    findings.report("robot.elements", error.what());
  }
}

/// Directions of a tip whose table or chains can be read.
std::vector<Eigen::Vector3d> modelled_directions(const setup::Robot& robot) {
  std::vector<Eigen::Vector3d> directions;
  try {
    const robot::Tip tip = setup::tip_model(before_learning(robot), {})({});
    const auto* modal = std::get_if<dynamics::ModalModel>(&tip);
    const auto* spatial = std::get_if<dynamics::SpatialModel>(&tip);
    for (const dynamics::Dof& dof : modal != nullptr ? modal->dofs : spatial->dofs) {
      if (dof.kind == dynamics::DofKind::translation) directions.push_back(dof.direction);
    }
  } catch (const core::Error&) {
    directions.clear();  // said by the checks of the model
  }
  return directions;
}

/// Checks that a robot which carries the tool has poles, and holds nothing else.
void check_carrier(const Case& source, Findings& findings) {
  if (!source.contacts.empty()) {
    findings.report(
        "robot.carries",
        "the robot carries the tool and touches no part besides; remove [[contacts]], or set it to \"part\"");
  }
  if (setup::kind(*source.robot) == setup::RobotKind::measured) {
    findings.report("robot.model",
                    "FRFs at the tip of a robot that carries the tool are those of the tool; give them as "
                    "[[tool.measured]] and remove [robot]");
  }
  if (source.tool &&
      (!source.tool->measured.empty() || (source.tool->swap && !setup::swapped_on_robot(*source.tool)))) {
    findings.report(
        "robot.carries",
        "the robot is in what was measured at the tool already; remove [robot], or give tool.modes in place "
        "of the measured FRFs");
  }
}

}  // namespace

std::vector<Eigen::Vector3d> tip_directions(const setup::Robot& robot) {
  using Directions = std::vector<Eigen::Vector3d>;
  const auto modelled = [&](const auto& /*read by the tip's model*/) { return modelled_directions(robot); };
  return std::visit(
      core::overloaded{
          [](const setup::OneModeRobot& model) { return Directions{model.direction}; },
          [](const setup::ModalRobot& model) {
            Directions directions;
            for (const setup::TipMode& mode : model.modes) directions.push_back(mode.direction);
            return directions;
          },
          [](const setup::MeasuredRobot& model) {
            if (model.measured.size() <= 1) return Directions{model.direction};
            Directions directions;
            for (const setup::MeasuredFrf& frf : model.measured) {
              if (const auto d = direction_of(frf.response)) directions.push_back(*d);
            }
            return directions;
          },
          [](const setup::JointedRobot&) {
            return Directions{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
          },
          modelled},
      robot.model);
}

std::string fault_of_posture(const setup::PartSetup& part, const setup::SupportSetup& support,
                             std::optional<Eigen::VectorXd>& near) {
  const auto* robot = std::get_if<setup::JointedRobot>(&support.robot->model);
  if (robot == nullptr) return "";
  try {
    const setup::RobotPosture stands = setup::robot_posture(part, support, near);
    (void)robot::linearised(robot->arm, stands.posture, support.robot->point);
    near = stands.posture.q;
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

void check_robot(const Case& source, Findings& findings) {
  const setup::Robot& robot = *source.robot;
  if (findings.unreadable("robot.model")) return;
  if (setup::carries_tool(source.robot)) check_carrier(source, findings);
  if (const Table base{source.values, "robot.base"}; base.exists()) {
    if (std::abs(base.direction("x").dot(base.direction("z"))) > 1e-9)
      return findings.report("robot.base.x", "is not at a right angle to robot.base.z; a frame's axes are");
  }
  const Table keys{source.values, "robot"};
  for (const char* key : {"over", "at", "joint_columns"}) {
    if (keys.has(key) && !keys.has("postures"))
      findings.report(std::string("robot.") + key, "belongs to robot.postures; give that list, or remove the key");
  }
  std::visit(
      core::overloaded{[&](const setup::OneModeRobot& model) { check_one_mode(model, findings); },
                       [](const setup::ModalRobot&) {},
                       [&](const setup::MeasuredRobot& model) { check_measured_robot(model, robot.point, findings); },
                       [&](const setup::TabledRobot& model) {
                         check_table(robot, model, findings);
                         check_mean(source, model, findings);
                       },
                       [&](const setup::JointedRobot& model) { check_arm(source, model, findings); },
                       [&](const setup::ChainedRobot&) { check_elements(source, findings); }},
      robot.model);
}

}  // namespace thinwall::cases

#include "robot/serial_arm.hpp"

#include <cmath>
#include <string>

#include "core/faults.hpp"
#include "dynamics/rigid_body.hpp"

namespace thinwall::robot {

namespace {

void check(const Link& link, const std::string& where, core::Faults& faults) {
  const Joint& joint = link.joint;
  faults.require(
      dynamics::is_frame(link.placement), where,
      "has a placement that is no frame: its axes must be of unit length, at right angles and right-handed, to "
      "nine digits");
  faults.require(std::abs(link.axis.norm() - 1.0) <= 1e-9, where, "has a joint axis that is not a unit vector");
  faults.require_number(joint.stiffness, joint.stiffness > 0.0, where,
                        link.slides ? "joint stiffness (N/m)" : "joint stiffness (N m/rad)",
                        "be positive (a joint that does not give is left out: join the two links)");
  faults.require_number(joint.damping, joint.damping >= 0.0, where,
                        link.slides ? "joint damping (N s/m)" : "joint damping (N m s/rad)", "not be negative");
  faults.require_number(joint.motor_inertia, joint.motor_inertia >= 0.0, where, "motor inertia (kg m^2)",
                        "not be negative");
  faults.require_number(joint.gear_ratio, joint.gear_ratio != 0.0, where, "gear ratio", "not be zero");
  if (!joint.motor_locked()) {
    faults.require_number(joint.servo_stiffness, joint.servo_stiffness >= 0.0, where, "servo stiffness (N m/rad)",
                          "not be negative");
    faults.require_number(joint.servo_damping, joint.servo_damping >= 0.0, where, "servo damping (N m s/rad)",
                          "not be negative");
    faults.require_number(joint.motor_inertia, joint.motor_inertia > 0.0, where, "motor inertia (kg m^2)",
                          "be positive where a servo of finite stiffness holds the motor");
  }
  dynamics::check(dynamics::RigidBody{link.mass, link.centre, link.inertia}, where, faults);
}

void check(const Counterbalance& spring, Eigen::Index links, const std::string& where, core::Faults& faults) {
  const auto known = [&](int link) { return link >= -1 && link < links; };
  faults.require(known(spring.from) && known(spring.to), where, "is fixed to a link that the arm does not have");
  faults.require(spring.from != spring.to, where, "has both ends on one link, where it does nothing");
  faults.require(spring.from_point.allFinite() && spring.to_point.allFinite() && std::isfinite(spring.force), where,
                 "has an end or a force that is not a number");
  faults.require_number(spring.length, spring.length >= 0.0, where, "length (m)", "not be negative");
  faults.require_number(spring.stiffness, spring.stiffness >= 0.0, where, "stiffness (N/m)", "not be negative");
  faults.require(spring.stiffness > 0.0 || spring.force != 0.0, where, "has neither force nor stiffness");
}

}  // namespace

void require_valid(const SerialArm& arm) {
  core::Faults faults;
  faults.require(!arm.links.empty(), "the arm", "has no link");
  faults.require(dynamics::is_frame(arm.base) && dynamics::is_frame(arm.tip), "the arm",
                 "has a base or a tip that is no frame: axes of unit length, at right angles and right-handed");
  faults.require(arm.gravity.allFinite(), "the arm", "has a gravity that is not a number");
  for (std::size_t i = 0; i < arm.links.size(); ++i) {
    const Link& link = arm.links[i];
    check(link, "link " + std::to_string(i + 1) + (link.name.empty() ? "" : " (" + link.name + ")"), faults);
  }
  for (std::size_t i = 0; i < arm.counterbalances.size(); ++i)
    check(arm.counterbalances[i], arm.joints(), "counterbalance " + std::to_string(i + 1), faults);
  faults.raise("robot arm");
}

}  // namespace thinwall::robot

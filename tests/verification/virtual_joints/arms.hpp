#pragma once
// Arms of the size of a KUKA KR270 R2700 (its data sheet's lengths) with plausible tubes, and any chain without rigid
// offsets as a frame of beams.

#include <gtest/gtest.h>

#include <numbers>

#include "fem/beam.hpp"
#include "robot/virtual_joints.hpp"

namespace thinwall {

using robot::BeamLink;
using robot::Chain;
using robot::RigidLink;
using robot::VirtualJoint;

inline dynamics::BeamSection steel_tube(double outer, double inner) {
  return dynamics::section({outer, inner, 210e9, 0.3, 7850.0});
}

inline RigidLink pitched(double degrees) {
  return {Eigen::Isometry3d(Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, Eigen::Vector3d::UnitY()))};
}

inline VirtualJoint motor(const Eigen::Vector3d& axis, double degrees, double stiffness) {
  return {.axis = axis,
          .position = degrees * std::numbers::pi / 180.0,
          .stiffness = stiffness,
          .damping = 2e-4 * stiffness};
}

/// The bodies that an arm carries besides its links: at the elbow, at the wrist, at the tip.
struct Masses {
  double elbow = 80.0;
  double wrist = 40.0;
  double tip = 240.0;
};

inline dynamics::RigidBody cube(double mass, double side) {
  return {mass, Eigen::Vector3d::Zero(), mass * side * side / 6.0 * Eigen::Matrix3d::Identity()};
}

/// Joints 1 to 3 about z, y, y; the hand in line with the forearm. Degrees as on the robot's pendant.
inline Chain three_joint_arm(const Eigen::Vector3d& q, const Masses& masses) {
  const auto x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
  return {.base = pitched(-90.0).placement,
          .elements = {motor(x, q(0), 4e6), BeamLink{steel_tube(0.45, 0.41), 0.675}, pitched(90.0),
                       BeamLink{steel_tube(0.40, 0.36), 0.350}, motor(y, q(1), 5e6),
                       BeamLink{steel_tube(0.30, 0.26), 1.150}, cube(masses.elbow, 0.3), motor(y, q(2), 3e6),
                       BeamLink{steel_tube(0.24, 0.20), 1.200}, cube(masses.wrist, 0.2),
                       BeamLink{steel_tube(0.18, 0.12), 0.215}, cube(masses.tip, 0.3)}};
}

/// The arm with a wrist of three joints.
inline Chain six_joint_arm(const Eigen::Vector<double, 6>& q, const Masses& masses) {
  const auto x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
  Chain arm = three_joint_arm(q.head<3>(), masses);
  arm.elements.insert(arm.elements.end() - 2, {motor(x, q(3), 2e6), cube(20.0, 0.2), motor(y, q(4), 1.5e6),
                                               cube(10.0, 0.15), motor(x, q(5), 1e6)});
  return arm;
}

/// The chain as beams of so many elements each, hinges for its joints; its end is the node "tip".
inline dynamics::SpatialModel beam_model(const Chain& chain, int elements) {
  fem::BeamFrame frame{.nodes = {{chain.base.translation(), "", true}}, .segments = {}};
  Eigen::Isometry3d at = chain.base;
  const auto add_node = [&] {
    frame.nodes.push_back({at.translation()});
    return frame.nodes.size() - 1;
  };
  for (const robot::ChainElement& element : chain.elements) {
    const std::size_t here = frame.nodes.size() - 1;
    const Eigen::Matrix3d R = at.linear();
    if (const auto* link = std::get_if<RigidLink>(&element)) {
      EXPECT_TRUE(link->placement.translation().isZero(0.0));
      at = at * link->placement;
    } else if (const auto* joint = std::get_if<VirtualJoint>(&element)) {
      frame.hinges.push_back({here, add_node(), R * joint->axis, joint->stiffness, joint->damping});
      at = at * Eigen::AngleAxisd(joint->position, joint->axis);
    } else if (const auto* beam = std::get_if<BeamLink>(&element)) {
      at = at * Eigen::Translation3d(beam->length, 0.0, 0.0);
      frame.segments.push_back({here, add_node(), beam->section, elements, R.col(1)});
    } else {
      const auto& body = std::get<dynamics::RigidBody>(element);
      frame.bodies.push_back({here, {body.mass_kg, R * body.centre_m, R * body.inertia_kg_m2 * R.transpose()}});
    }
  }
  frame.nodes.back().name = "tip";
  return fem::spatial_model(frame);
}

}  // namespace thinwall

#pragma once
// Arms to test with: the four-axis one of Huynh et al. 2017 (tables 1 and 2, Eq. 1-5), and arms at random.

#include <numbers>
#include <random>

#include "robot/serial_arm.hpp"

namespace thinwall::robot {

inline Link huynh_link(const char* name, double below, const Eigen::Vector3d& axis, double mass, double length,
                       const Eigen::Vector3d& inertia, double stiffness, double damping) {
  Link link;
  link.name = name;
  link.placement.translation().z() = below;
  link.axis = axis;
  link.joint.stiffness = stiffness;
  link.joint.damping = damping;
  link.mass = mass;
  link.centre = {0.0, 0.0, 0.5 * length};
  link.inertia = inertia.asDiagonal();
  return link;
}

inline SerialArm huynh_arm() {
  const auto y = Eigen::Vector3d::UnitY();
  SerialArm arm;
  arm.links = {
      huynh_link("shoulder", 0.0, Eigen::Vector3d::UnitZ(), 342, 0.65, {18.044, 29.213, 30.014}, 3.8e6, 1057.2),
      huynh_link("main arm", 0.65, y, 243, 0.95, {35.033, 37.463, 4.050}, 6.6e6, 1393.3),
      huynh_link("forearm", 0.95, y, 202, 0.85, {5.507, 5.507, 4.547}, 3.9e6, 1071.0),
      huynh_link("spindle", 0.85, y, 11, 0.2, {0.103, 0.103, 0.041}, 0.66e6, 440.6),
  };
  arm.tip.translation().z() = 0.2;
  return arm;
}

/// The posture of the reference values: q = (0, 0.2, 1.2, π − 1.4).
inline Eigen::VectorXd huynh_posture() {
  return Eigen::Vector4d(0.0, 0.2, 1.2, std::numbers::pi - 1.4);
}

inline double uniform(std::mt19937_64& random, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random);
}

inline Eigen::Vector3d random_vector(std::mt19937_64& random) {
  return {uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
}

inline Eigen::Isometry3d random_frame(std::mt19937_64& random) {
  Eigen::Isometry3d frame(Eigen::AngleAxisd(uniform(random, -3, 3), random_vector(random).normalized()));
  frame.translation() = random_vector(random);
  return frame;
}

/// An arm without any symmetry: base, joints, axes, centres, inertias and tip at random.
inline SerialArm random_arm(std::mt19937_64& random, int joints) {
  SerialArm arm;
  arm.base = random_frame(random);
  arm.tip = random_frame(random);
  arm.gravity = 9.81 * random_vector(random).normalized();
  for (int i = 0; i < joints; ++i) {
    Link link;
    link.placement = random_frame(random);
    link.axis = random_vector(random).normalized();
    link.joint = {.stiffness = 1e5, .damping = 10.0, .motor_inertia = 0.0, .gear_ratio = 1.0};
    link.mass = uniform(random, 1, 50);
    link.centre = random_vector(random);
    // The inertia of a cuboid in its own axes.
    const Eigen::Vector3d squares = random_vector(random).cwiseAbs2();
    const Eigen::Matrix3d R = random_frame(random).linear();
    link.inertia = R * (link.mass / 12.0 * (squares.sum() - squares.array()).matrix()).asDiagonal() * R.transpose();
    arm.links.push_back(link);
  }
  return arm;
}

/// A random arm of which every second joint slides, from the first on.
inline SerialArm random_sliding_arm(std::mt19937_64& random, int joints) {
  SerialArm arm = random_arm(random, joints);
  for (std::size_t i = 0; i < arm.links.size(); i += 2) arm.links[i].slides = true;
  return arm;
}

inline Eigen::VectorXd random_posture(std::mt19937_64& random, Eigen::Index joints) {
  Eigen::VectorXd q(joints);
  for (double& angle : q) angle = uniform(random, -3, 3);
  return q;
}

}  // namespace thinwall::robot

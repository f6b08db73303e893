#pragma once
// A serial arm of rigid links on revolute joints that give: what a table, a data sheet or a URDF says of a robot.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>
#include <string>
#include <vector>

namespace thinwall::robot {

/// What a joint's gearbox and motor are to a vibration, about the joint's axis (Spong 1987): the rotor, held by the
/// servo's position loop, carries the link by the gearbox. All but the rotor's inertia on the side of the link.
struct Joint {
  double stiffness = 0.0;      ///< of gearbox and shaft, N m/rad, > 0
  double damping = 0.0;        ///< beside the stiffness, N m s/rad, ≥ 0
  double motor_inertia = 0.0;  ///< of the rotor about its own shaft, kg m², ≥ 0; > 0 unless the motor is locked
  double gear_ratio = 1.0;     ///< turns of the rotor for one of the joint, ≠ 0
  double servo_stiffness = std::numeric_limits<double>::infinity();  ///< N m/rad, ≥ 0; infinite: the motor is locked
  double servo_damping = 0.0;  ///< N m s/rad, ≥ 0; without meaning for a locked motor

  /// Whether the motor does not turn.
  [[nodiscard]] bool motor_locked() const { return servo_stiffness == std::numeric_limits<double>::infinity(); }
};

/// A rigid body and the joint that carries it. At q = 0 its frame is the joint's; q turns it about `axis`.
struct Link {
  std::string name;
  Eigen::Isometry3d placement = Eigen::Isometry3d::Identity();  ///< of the joint in the frame of the link before, m
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();              ///< unit vector in the joint's frame
  Joint joint;
  double mass = 0.0;                                  ///< kg, ≥ 0
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();   ///< of mass, in the link's frame, m
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the centre of mass, in the link's axes, kg m²
};

/// A spring or a gas cylinder between two points of the arm, straight and without mass: it pulls them together with
/// F = force + stiffness (l − length), l their distance.
struct Counterbalance {
  int from = -1;                                         ///< number of the link from 0; −1: the base
  Eigen::Vector3d from_point = Eigen::Vector3d::Zero();  ///< in that link's frame, m
  int to = 0;                                            ///< another one
  Eigen::Vector3d to_point = Eigen::Vector3d::Zero();    ///< in its frame, m
  double force = 0.0;                                    ///< N, at `length`; negative: it pushes
  double length = 0.0;                                   ///< m, ≥ 0
  double stiffness = 0.0;                                ///< N/m, ≥ 0; zero: the force is the same at any length
};

/// Links from the base to the tip. All results are in the axes of the world, in which the base stands.
struct SerialArm {
  Eigen::Isometry3d base = Eigen::Isometry3d::Identity();  ///< frame before the first joint, in the world, m
  std::vector<Link> links;
  Eigen::Isometry3d tip = Eigen::Isometry3d::Identity();  ///< in the last link's frame, m
  Eigen::Vector3d gravity = {0.0, 0.0, -9.81};            ///< m/s²
  std::vector<Counterbalance> counterbalances{};

  /// Number of joints, one a link.
  [[nodiscard]] Eigen::Index joints() const { return static_cast<Eigen::Index>(links.size()); }
};

/// Throws InputError with every violation at once, each with the link's name: no link, a frame that is none (mirrored,
/// or its axes not orthonormal to 1e-9), an axis that is no unit vector, a joint without stiffness, a motor that turns
/// without inertia, negative damping, mass, motor inertia or servo gain, no gear ratio, an inertia tensor that no body
/// has (not symmetric, or a principal moment negative or larger than the sum of the other two), a counterbalance
/// between links that are not there or between a link and itself, or one that pushes as it is stretched, a number that
/// is not finite.
void require_valid(const SerialArm& arm);

}  // namespace thinwall::robot

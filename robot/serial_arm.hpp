#pragma once
// The description of a serial arm with rigid links and flexible joints that turn or slide, as given by a table, a data
// sheet or a URDF.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>
#include <string>
#include <vector>

namespace thinwall::robot {

/// The gearbox and motor of a joint, about the joint's axis (Spong 1987): the rotor is held by the servo's position
/// loop and drives the link through the gearbox. All values but the rotor's inertia are referred to the side of the
/// link. Of a joint that slides, read N/m, N s/m and radians of the rotor for one metre.
struct Joint {
  double stiffness = 0.0;      ///< stiffness of gearbox and shaft, N m/rad, > 0
  double damping = 0.0;        ///< damping parallel to the stiffness, N m s/rad, ≥ 0
  double motor_inertia = 0.0;  ///< rotor about its own shaft, kg m², ≥ 0; > 0 unless the motor is locked
  double gear_ratio = 1.0;     ///< turns of the rotor for one of the joint, ≠ 0
  double servo_stiffness = std::numeric_limits<double>::infinity();  ///< N m/rad, ≥ 0; infinite for a locked motor
  double servo_damping = 0.0;                                        ///< N m s/rad, ≥ 0; ignored for a locked motor

  /// True if the motor does not turn.
  [[nodiscard]] bool motor_locked() const { return servo_stiffness == std::numeric_limits<double>::infinity(); }
};

/// A rigid link with the joint that carries it. At q = 0 the link's frame is the joint's; q (rad) turns it about
/// `axis`, or (m) slides it along `axis`.
struct Link {
  std::string name;
  Eigen::Isometry3d placement = Eigen::Isometry3d::Identity();  ///< joint's frame in that of the link before, m
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();              ///< unit vector in the joint's frame
  Joint joint;
  double mass = 0.0;                                  ///< kg, ≥ 0
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();   ///< centre of mass in the link's frame, m
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the centre of mass, in the link's axes, kg m²
  bool slides = false;                                ///< true of a joint that slides
};

/// A counterbalance, which is a spring or a gas cylinder between two points of the arm, straight and massless. It pulls
/// them together with F = force + stiffness (l − length), l their distance.
struct Counterbalance {
  int from = -1;                                         ///< number of the link, from 0; −1 for the base
  Eigen::Vector3d from_point = Eigen::Vector3d::Zero();  ///< in that link's frame, m
  int to = 0;                                            ///< number of another link, or −1
  Eigen::Vector3d to_point = Eigen::Vector3d::Zero();    ///< in the frame of that link, m
  double force = 0.0;                                    ///< N, at `length`; negative if it pushes
  double length = 0.0;                                   ///< m, ≥ 0
  double stiffness = 0.0;                                ///< N/m, ≥ 0; zero for a constant force
};

/// A serial arm: its links from the base to the tip. All results are in the axes of the world, in which the base is
/// fixed.
struct SerialArm {
  Eigen::Isometry3d base = Eigen::Isometry3d::Identity();  ///< frame before the first joint, in the world, m
  std::vector<Link> links;
  Eigen::Isometry3d tip = Eigen::Isometry3d::Identity();  ///< in the last link's frame, m
  Eigen::Vector3d gravity = {0.0, 0.0, -9.81};            ///< m/s²
  std::vector<Counterbalance> counterbalances{};

  /// Number of joints, which is that of the links.
  [[nodiscard]] Eigen::Index joints() const { return static_cast<Eigen::Index>(links.size()); }
};

/// Throws InputError that lists every violation with the link's name: no link; a frame that is mirrored or whose axes
/// are not orthonormal to 1e-9; an axis that is no unit vector; a joint without stiffness; a motor that turns without
/// inertia; negative damping, mass, motor inertia or servo gain; a gear ratio of zero; an inertia tensor that no body
/// has (not symmetric, or a principal moment negative or larger than the sum of the other two); a counterbalance
/// between links that do not exist or between a link and itself, one of negative stiffness, or with neither force nor
/// stiffness; a number that is not finite.
void require_valid(const SerialArm& arm);

}  // namespace thinwall::robot

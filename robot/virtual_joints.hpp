#pragma once
// Robots with flexible links and joints, serial or parallel, reduced to the six motions of their tip.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <variant>
#include <vector>

#include "dynamics/beam_element.hpp"
#include "dynamics/rigid_body.hpp"
#include "dynamics/spatial_model.hpp"
#include "robot/serial_arm.hpp"

namespace thinwall::robot {

/// A rigid link: a frame fixed relative to the one before.
struct RigidLink {
  Eigen::Isometry3d placement = Eigen::Isometry3d::Identity();
};

/// A joint that rotates about its axis or slides along it. A motor holds it with a stiffness (N m/rad, N/m; infinite if
/// locked) and a damper (N m s/rad, N s/m); a joint without stiffness is passive.
struct VirtualJoint {
  /// The motion that the joint allows the frame behind it.
  enum class Motion { rotation, translation };
  Motion motion = Motion::rotation;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit vector, in the frame before
  double position = 0.0;                            ///< rad, m
  double stiffness = 0.0;
  double damping = 0.0;
};

/// A beam along the x axis of the frame before; the frame after has the same axes and lies at its end.
struct BeamLink {
  dynamics::BeamSection section;
  double length = 0.0;  ///< m, > 0
};

/// A spring in six directions at the current frame, in its axes, such as the compliance at the end of a link that was
/// identified by other means. It is symmetric and positive semidefinite, of any rank; m/N, rad/N, m/(N m), rad/(N m).
struct VirtualSpring {
  dynamics::Matrix6 compliance = dynamics::Matrix6::Zero();
};

/// An element of a chain from the base to the tip; a body is fixed to the frame at its place in the chain.
using ChainElement = std::variant<RigidLink, VirtualJoint, BeamLink, VirtualSpring, dynamics::RigidBody>;

/// A chain of elements from the base to the tip.
struct Chain {
  Eigen::Isometry3d base = Eigen::Isometry3d::Identity();  ///< in the world, m
  std::vector<ChainElement> elements;
};

/// The chain of the rigid links and flexible joints of a serial arm at q (rad, m), without its weight.
/// Throws InputError as pose() and require_valid() do, and for a motor that is not locked: its servo and gearbox must
/// be combined in series.
[[nodiscard]] Chain chain(const SerialArm& arm, const Eigen::VectorXd& q);

/// The reduced model of a tip, M y'' + C y' + K y = Zᵀ f, δt = Z y, with δt = (x, y, z, rx, ry, rz) in the axes of the
/// world. Z is the identity unless some motion is impossible; K is singular if some motion is free.
struct ReducedTip {
  Eigen::Matrix<double, 6, Eigen::Dynamic> Z;
  Eigen::MatrixXd M, C, K;
  Eigen::Index free = 0;  ///< number of motions that no spring holds, the rank deficiency of K

  /// Number of motions that are impossible.
  [[nodiscard]] Eigen::Index rigid() const { return 6 - Z.cols(); }
};

/// The reduced model of a robot (Bondarenko et al. 2012, section 2), with one chain or several that hold the same
/// platform, each from its own base (Pashkevich, Chablat & Wenger 2009). With the springs' compliances C_θ and the
/// Jacobians of springs and passive joints, a chain under the wrench F on its tip has
///
///     δt = J_θ θ + J_p p,    θ = C_θ J_θᵀ F,    J_pᵀ F = 0
///
/// so that F = N f with N a basis of null(J_pᵀ), and K = N (Nᵀ J_θ C_θ J_θᵀ N)⁻¹ Nᵀ. If the bracket is singular, a
/// wrench strains nothing and so forbids a motion; Z spans the motions that no chain forbids. It is found with
/// rotations scaled by the robot's size; singular values below 1e-9 of the largest count as zero. The stiffnesses of
/// chains add up. δt determines θ, p (the smallest if there are several) and the motions of all ends of links, q = J_q
/// δt; with the sections of links moving as those of tip-loaded beams (Eq. 13-15 with dynamics::section_motion()),
///
///     M_r = Zᵀ J_qᵀ M_tot J_q Z    (Eq. 10),    C_r likewise of the dampers
///
/// This is a Ritz model: its statics are exact, and its frequencies (Eq. 21) are upper bounds of those of the full
/// model of the same robot, close to them if the tip carries most of the moving mass (docs/theory/robots.md gives
/// measurements). Throws InputError that lists every violation, for chains that do not end at one point, and for a tip
/// that cannot move. Cost O(joints).
[[nodiscard]] ReducedTip reduced_tip(const std::vector<Chain>& chains);

/// The compliance of the tip S_r = Z K⁻¹ Zᵀ, of rank 6 − rigid. Throws InputError if a motion is free.
[[nodiscard]] dynamics::Matrix6 compliance(const ReducedTip& tip);

/// The stiffness of the tip K_r = Z⁻ᵀ K Z⁻¹, of rank 6 − free. Throws InputError if a motion is impossible; K over the
/// coordinates y must then be used.
[[nodiscard]] dynamics::Matrix6 stiffness(const ReducedTip& tip);

/// The spatial model with the tip's six DOFs under the name `point`. The coordinates are y, and T = Z unless they are
/// the DOFs. Throws InputError if a motion moves no mass.
[[nodiscard]] dynamics::SpatialModel spatial_model(const ReducedTip& tip, const std::string& point);

}  // namespace thinwall::robot

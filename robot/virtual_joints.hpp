#pragma once
// Robots of links and joints that all give, serial or parallel, reduced to the six motions of their tip.

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

/// A frame fixed in the one before.
struct RigidLink {
  Eigen::Isometry3d placement = Eigen::Isometry3d::Identity();
};

/// Turns about its axis, or slides along it. A motor holds it by a stiffness (N m/rad, N/m; infinite: it is locked) and
/// a damper (N m s/rad, N s/m); without stiffness it is passive.
struct VirtualJoint {
  /// What the joint lets the frame behind it do.
  enum class Motion { rotation, translation };
  Motion motion = Motion::rotation;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit vector, in the frame before
  double position = 0.0;                            ///< rad, m
  double stiffness = 0.0;
  double damping = 0.0;
};

/// A beam along x of the frame before; the frame after has the same axes at its end.
struct BeamLink {
  dynamics::BeamSection section;
  double length = 0.0;  ///< m, > 0
};

/// A spring of six directions where the frame is, in its axes: the compliance of a link that was identified otherwise,
/// at its end. Symmetric, positive semidefinite, of any rank; m/N, rad/N, m/(N m), rad/(N m).
struct VirtualSpring {
  dynamics::Matrix6 compliance = dynamics::Matrix6::Zero();
};

/// What follows each other from the base to the tip; a body is fixed to the frame in which it stands.
using ChainElement = std::variant<RigidLink, VirtualJoint, BeamLink, VirtualSpring, dynamics::RigidBody>;

/// One way from the base to the tip.
struct Chain {
  Eigen::Isometry3d base = Eigen::Isometry3d::Identity();  ///< in the world, m
  std::vector<ChainElement> elements;
};

/// The rigid links and flexible joints of a serial arm at the joint angles q (rad), without its weight. Throws
/// InputError as pose() and require_valid(), and for a motor that is not locked: put its servo and gearbox in a row.
[[nodiscard]] Chain chain(const SerialArm& arm, const Eigen::VectorXd& q);

/// M y'' + C y' + K y = Zᵀ f of a tip that moves by δt = Z y: x, y, z, rx, ry, rz in the axes of the world. Z is the
/// identity unless some motion is impossible; K is singular where one is free.
struct ReducedTip {
  Eigen::Matrix<double, 6, Eigen::Dynamic> Z;
  Eigen::MatrixXd M, C, K;
  Eigen::Index free = 0;  ///< motions that no spring holds: what K lacks in rank

  /// Number of motions that are impossible.
  [[nodiscard]] Eigen::Index rigid() const { return 6 - Z.cols(); }
};

/// The reduced model of Bondarenko et al. 2012, section 2, for one chain or several that hold the same platform, each
/// from its own base (Pashkevich, Chablat & Wenger 2009). With the springs' compliances C_θ and the Jacobians of
/// springs and passive joints, a chain under the wrench F on its tip has
///
///     δt = J_θ θ + J_p p,    θ = C_θ J_θᵀ F,    J_pᵀ F = 0
///
/// so F = N f, N a basis of null(J_pᵀ), and K = N (Nᵀ J_θ C_θ J_θᵀ N)⁻¹ Nᵀ. Where the bracket is singular, a wrench
/// strains nothing and forbids a motion; those that no chain forbids are Z, found with rotations scaled by the robot's
/// size, singular values below 1e-9 of the largest being none. The stiffnesses of chains add. From δt follow θ, p (of
/// several, the least) and all ends of links, q = J_q δt, and with the sections between moved as those of tip-loaded
/// beams (Eq. 13-15 with dynamics::section_motion)
///
///     M_r = Zᵀ J_qᵀ M_tot J_q Z    (Eq. 10),    C_r likewise of the dampers
///
/// A Ritz model: exact at rest, its frequencies (Eq. 21) are upper bounds of those of the same robot in full, good
/// where the tip carries most of the mass that moves (docs/theory/robots.md measures it). Throws InputError with every
/// violation at once, for chains that do not end at one point, and for a tip that cannot move. Cost O(joints).
[[nodiscard]] ReducedTip reduced_tip(const std::vector<Chain>& chains);

/// S_r = Z K⁻¹ Zᵀ, of rank 6 − rigid. Throws InputError if a motion is free.
[[nodiscard]] dynamics::Matrix6 compliance(const ReducedTip& tip);

/// K_r = Z⁻ᵀ K Z⁻¹, of rank 6 − free. Throws InputError if a motion is impossible: there, K over y stands for it.
[[nodiscard]] dynamics::Matrix6 stiffness(const ReducedTip& tip);

/// The tip's six DOFs under the name `point`; the coordinates are y, T = Z unless they are the DOFs. Throws InputError
/// if a motion moves no mass.
[[nodiscard]] dynamics::SpatialModel spatial_model(const ReducedTip& tip, const std::string& point);

}  // namespace thinwall::robot

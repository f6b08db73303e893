#pragma once
// Contacts between components: the points that touch, and the joint between them.

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "dynamics/dof.hpp"

namespace thinwall::coupling {

/// The joint between two points along one direction, Z(ω) = K (1 + iη) + iωC, or the joint of their rotations about it.
/// All other directions are free.
struct ContactSpring {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();        ///< unit vector, part axes
  double stiffness = std::numeric_limits<double>::infinity();  ///< K > 0, N/m or N m/rad; infinite if rigid
  double damping = 0.0;                                     ///< C ≥ 0, N s/m or N m s/rad; ignored if K is infinite
  double loss_factor = 0.0;                                 ///< η ≥ 0; ignored if K is infinite
  dynamics::DofKind kind = dynamics::DofKind::translation;  ///< displacement along the direction or rotation about it

  /// True if the direction is joined rigidly.
  [[nodiscard]] bool rigid() const { return stiffness == std::numeric_limits<double>::infinity(); }
};

/// The matrices of a joint whose directions are coupled, as those of tool and holder are: Z(ω) = K + iD + iωC over the
/// contact's directions, in their order; N/m, N/rad, N m/m, N m/rad (times s for C). All are symmetric; K is positive
/// definite, C and D are positive semidefinite.
struct JointMatrices {
  Eigen::MatrixXd K;
  Eigen::MatrixXd C{};  ///< empty: none
  Eigen::MatrixXd D{};  ///< empty: none
};

/// A contact of a point with a point of another component (or of the same), joined in some directions, which need not
/// be orthogonal: translations of both along a direction, or rotations about it.
struct Contact {
  std::string point_a;
  std::string point_b;
  std::vector<ContactSpring> springs;
  JointMatrices matrices{};  ///< if K is given, used instead of the springs' own values

  /// True if `matrices` replace the springs' own values.
  [[nodiscard]] bool has_matrices() const { return matrices.K.size() > 0; }
};

/// Throws InputError that lists every violation: no contact, a point joined to itself, no spring, a direction that is
/// not a unit vector, a stiffness that is not positive, negative damping or loss, matrices of another size, not
/// symmetric or of the wrong sign, or values given both by springs and by matrices.
void require_valid(const std::vector<Contact>& contacts);

}  // namespace thinwall::coupling

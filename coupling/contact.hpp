#pragma once
// Where and how two components touch.

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "dynamics/dof.hpp"

namespace thinwall::coupling {

/// What joins the two points along one direction, Z(ω) = K (1 + iη) + iωC, or about it. All other directions stay free.
struct ContactSpring {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();        ///< unit vector, part axes
  double stiffness = std::numeric_limits<double>::infinity();  ///< K > 0, N/m or N m/rad; infinite: both move as one
  double damping = 0.0;      ///< C ≥ 0, N s/m or N m s/rad; without meaning if K is infinite
  double loss_factor = 0.0;  ///< η ≥ 0; without meaning if K is infinite
  dynamics::DofKind kind = dynamics::DofKind::translation;  ///< a displacement along the direction or a turn about it

  /// Whether the direction is joined without any give.
  [[nodiscard]] bool rigid() const { return stiffness == std::numeric_limits<double>::infinity(); }
};

/// A joint whose directions act on each other, as tool and holder do: Z(ω) = K + iD + iωC over the contact's
/// directions, in their order; N/m, N/rad, N m/m, N m/rad (and times s for C). Symmetric; K positive definite, C and D
/// not negative.
struct JointMatrices {
  Eigen::MatrixXd K;
  Eigen::MatrixXd C{};  ///< empty: none
  Eigen::MatrixXd D{};  ///< empty: none
};

/// A point against a point of another component (or of the same), joined in some directions, which need not be
/// orthogonal: translations of both along one, or rotations about one.
struct Contact {
  std::string point_a;
  std::string point_b;
  std::vector<ContactSpring> springs;
  JointMatrices matrices{};  ///< K given: they stand for the springs' own values, which stay at their defaults

  /// Whether `matrices` stand for the springs' own values.
  [[nodiscard]] bool has_matrices() const { return matrices.K.size() > 0; }
};

/// Throws InputError with every violation at once: no contact, a point joined to itself, no spring, a direction that is
/// not a unit vector, a stiffness that is not positive, negative damping or loss, matrices of another size, not
/// symmetric or of the wrong sign, or values given twice.
void require_valid(const std::vector<Contact>& contacts);

}  // namespace thinwall::coupling

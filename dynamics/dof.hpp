#pragma once
// The table that says which row of a matrix is which. A DOF is named once it leaves the stage that numbered it.

#include <Eigen/Core>
#include <string>
#include <vector>

namespace thinwall::dynamics {

/// What moves.
enum class DofKind {
  translation,  ///< displacement of a point along `direction`; unit m
  rotation,     ///< rotation of a point about `direction`; unit rad
  modal,        ///< amplitude of a mode; has no direction; unit 1 (mass-normalised modes: kg^½ m)
};

/// One degree of freedom: the displacement (or rotation) of a named point along a unit direction in the part's axes.
/// The displacement of a point is the sum of its DOFs' amplitudes times their directions, u = Σ dᵢ qᵢ.
struct Dof {
  std::string point;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  DofKind kind = DofKind::translation;
};

/// The DOFs of rows or columns, in order.
using DofTable = std::vector<Dof>;

/// "P.x", "R.rz", "P.(0.6,0.8,0)", "mode 3".
[[nodiscard]] std::string name(const Dof& dof);

/// "m", "rad" or "1".
[[nodiscard]] std::string unit(const Dof& dof);

/// The three translations x, y, z of a point.
[[nodiscard]] DofTable translations(const std::string& point);

/// The three translations x, y, z of a point, then its rotations rx, ry, rz.
[[nodiscard]] DofTable six_dofs(const std::string& point);

/// Unit vector of "x", "-y", "z"; throws InputError for anything else.
[[nodiscard]] Eigen::Vector3d axis(const std::string& letter);

/// Rows of the DOFs that belong to `point`, in table order; throws InputError (naming the nearest point) if there are
/// none.
[[nodiscard]] std::vector<int> rows_of_point(const DofTable& dofs, const std::string& point);

/// Row of the DOF named "P.x" (see name()); throws InputError with the nearest name if there is none.
[[nodiscard]] int row_of(const DofTable& dofs, const std::string& dof_name);

/// Row vector b with b·q = n·u_point: the displacement of `point` along n (unit vector), or its rotation about n where
/// `kind` says so, from the DOF amplitudes q. Shape: dofs.size(). Throws InputError if the point has no DOF of that
/// kind.
[[nodiscard]] Eigen::VectorXd displacement_row(const DofTable& dofs, const std::string& point, const Eigen::Vector3d& n,
                                               DofKind kind = DofKind::translation);

/// D of u_point = D q: column i holds the direction of DOF i where that is a translation of `point`, zeros elsewhere.
/// Shape: 3 × dofs.size(); its rows are displacement_row() along x, y, z. A point that has rotations only does not
/// move: D = 0. Throws InputError (naming the nearest point) if no DOF belongs to the point.
[[nodiscard]] Eigen::Matrix3Xd displacement_matrix(const DofTable& dofs, const std::string& point);

}  // namespace thinwall::dynamics

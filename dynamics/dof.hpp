#pragma once
// Named degrees of freedom (DOFs), and tables that state which row of a matrix belongs to which of them. Outside of the
// stage that numbered it, a DOF is always known by its name.

#include <Eigen/Core>
#include <string>
#include <vector>

namespace thinwall::dynamics {

/// The kind of motion that a DOF measures.
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

/// The DOFs of the rows or columns of a matrix, in order.
using DofTable = std::vector<Dof>;

/// The name of a DOF: "P.x", "R.rz", "P.(0.6,0.8,0)", "mode 3".
[[nodiscard]] std::string name(const Dof& dof);

/// The unit of a DOF's amplitude: "m", "rad" or "1".
[[nodiscard]] std::string unit(const Dof& dof);

/// The three translations x, y, z of a point.
[[nodiscard]] DofTable translations(const std::string& point);

/// The three translations x, y, z of a point, then its rotations rx, ry, rz.
[[nodiscard]] DofTable six_dofs(const std::string& point);

/// The unit vector of "x", "y", "z", "-x", "-y" or "-z". Throws InputError for anything else.
[[nodiscard]] Eigen::Vector3d axis(const std::string& letter);

/// The rows of the DOFs that belong to `point`, in table order; modal amplitudes belong to no point. Throws InputError
/// that names the nearest point if there are none.
[[nodiscard]] std::vector<int> rows_of_point(const DofTable& dofs, const std::string& point);

/// The row of the DOF named `dof_name`, as "P.x" (see name()). Throws InputError with the nearest name if there is
/// none.
[[nodiscard]] int row_of(const DofTable& dofs, const std::string& dof_name);

/// The row vector b with b·q = n·u_point: the displacement of `point` along the unit vector n as a function of the DOF
/// amplitudes q, or its rotation about n if `kind` says so. Shape: dofs.size(). Throws InputError if the point has no
/// DOF of that kind.
[[nodiscard]] Eigen::VectorXd displacement_row(const DofTable& dofs, const std::string& point, const Eigen::Vector3d& n,
                                               DofKind kind = DofKind::translation);

/// The matrix D of u_point = D q: column i holds the direction of DOF i if that is a translation of `point`, zeros
/// otherwise. Shape: 3 × dofs.size(); its rows are displacement_row() along x, y, z. For a point that has rotations
/// only, D = 0. Throws InputError that names the nearest point if no DOF belongs to the point.
[[nodiscard]] Eigen::Matrix3Xd displacement_matrix(const DofTable& dofs, const std::string& point);

}  // namespace thinwall::dynamics

#pragma once
// Sparse matrices K, M, C from a finite-element program that numbers nodes, with the table of their rows.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <map>
#include <string>
#include <vector>

#include "dynamics/dof.hpp"

namespace thinwall::dynamics {

/// A degree of freedom as finite-element programs number it.
struct NodeDof {
  int node = 0;
  int component = 0;  ///< 1, 2, 3: translation along x, y, z; 4, 5, 6: rotation about them; 0: amplitude of a mode
  friend bool operator==(const NodeDof&, const NodeDof&) = default;
  friend bool operator<(const NodeDof& a, const NodeDof& b) {
    return a.node < b.node || (a.node == b.node && a.component < b.component);
  }
};

/// A component with imported n × n matrices, both triangles stored. They are in the units of the file until
/// dynamics::in_si() has converted them.
struct SparseModel {
  Eigen::SparseMatrix<double> K;
  Eigen::SparseMatrix<double> M;
  Eigen::SparseMatrix<double> C{};  ///< viscous damping; 0 × 0 if there is none
  std::vector<NodeDof> dofs;
  std::map<int, Eigen::Vector3d> positions{};  ///< position of each node; may be empty or incomplete
  std::map<int, std::string> names{};          ///< name of each node or amplitude that has one

  /// Number of coordinates.
  [[nodiscard]] Eigen::Index size() const { return K.rows(); }
  /// True if there is a damping matrix C.
  [[nodiscard]] bool has_damping() const { return C.rows() > 0; }
};

/// The name of the point to which a row belongs: its given name, "P", or else "node 17" ("mode 17" for an amplitude).
[[nodiscard]] std::string point_name(const SparseModel& model, const NodeDof& dof);

/// The row as a named DOF, whose name() is "node 17.x", "P.rz" or "mode 3".
[[nodiscard]] Dof named(const SparseModel& model, const NodeDof& dof);

/// The table of all rows as named DOFs. Cost O(n).
[[nodiscard]] DofTable dof_table(const SparseModel& model);

/// Throws InputError, which names the rows, unless K, M (and C if there is one) are square, of one size, as long as the
/// table, and finite; no DOF occurs twice, no two nodes share a name, components are 0 … 6, and positions are finite.
/// Cost O(nnz + n log n).
void require_consistent(const SparseModel& model);

/// The pair of entries of a matrix that violates symmetry most, by |a_ij − a_ji| over the largest of |a_ij|, |a_ji|,
/// √|a_ii a_jj|.
struct Asymmetry {
  double relative = 0.0;
  int row = 0, column = 0;
  double upper = 0.0, lower = 0.0;  ///< a(row, column), a(column, row)
};
/// The worst asymmetry of a square matrix. Cost O(nnz).
[[nodiscard]] Asymmetry asymmetry(const Eigen::SparseMatrix<double>& A);

/// Throws InputError, with the DOFs' names and both values, if a matrix is asymmetric beyond `bound` (see Asymmetry) or
/// has a negative number on its diagonal, which no K, M or C of a part alone has. Cost O(nnz).
void require_plausible(const SparseModel& model, double bound = 1e-9);

}  // namespace thinwall::dynamics

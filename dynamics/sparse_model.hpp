#pragma once
// K, M, C of a program that numbers nodes, sparse as its files hold them, with the table of their rows.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <map>
#include <string>
#include <vector>

#include "dynamics/dof.hpp"

namespace thinwall::dynamics {

/// A row as finite-element programs number it.
struct NodeDof {
  int node = 0;
  int component = 0;  ///< 1, 2, 3: translation along x, y, z; 4, 5, 6: rotation about them; 0: amplitude of a mode
  friend bool operator==(const NodeDof&, const NodeDof&) = default;
  friend bool operator<(const NodeDof& a, const NodeDof& b) {
    return a.node < b.node || (a.node == b.node && a.component < b.component);
  }
};

/// An imported component, n × n, both triangles stored. In SI once dynamics::in_si() has converted it.
struct SparseModel {
  Eigen::SparseMatrix<double> K;
  Eigen::SparseMatrix<double> M;
  Eigen::SparseMatrix<double> C{};  ///< viscous; 0 × 0: none
  std::vector<NodeDof> dofs;
  std::map<int, Eigen::Vector3d> positions{};  ///< by node; may be empty, or lack some
  std::map<int, std::string> names{};          ///< of nodes that have one, and of amplitudes

  /// Number of coordinates.
  [[nodiscard]] Eigen::Index size() const { return K.rows(); }
  /// Whether there is a C.
  [[nodiscard]] bool has_damping() const { return C.rows() > 0; }
};

/// "P", or "node 17" ("mode 17" for an amplitude) where the node has no name.
[[nodiscard]] std::string point_name(const SparseModel& model, const NodeDof& dof);

/// The row as a named DOF; its name() is "node 17.x", "P.rz", "mode 3".
[[nodiscard]] Dof named(const SparseModel& model, const NodeDof& dof);

/// The whole table by names. Cost O(n).
[[nodiscard]] DofTable dof_table(const SparseModel& model);

/// Throws InputError unless K, M (and C if there is one) are square, of one size, as long as the table, and finite; no
/// DOF is there twice, no two nodes have one name, components are 0 … 6, positions finite. Names the rows. Cost
/// O(nnz + n log n).
void require_consistent(const SparseModel& model);

/// The worst pair of a matrix: |a_ij − a_ji| over the largest of |a_ij|, |a_ji|, √|a_ii a_jj|.
struct Asymmetry {
  double relative = 0.0;
  int row = 0, column = 0;
  double upper = 0.0, lower = 0.0;  ///< a(row, column), a(column, row)
};
/// Of a square matrix. Cost O(nnz).
[[nodiscard]] Asymmetry asymmetry(const Eigen::SparseMatrix<double>& A);

/// Throws InputError, with the DOFs' names and both values, if a matrix is asymmetric beyond `bound` (see Asymmetry) or
/// has a negative number on its diagonal, which no K, M or C of a part alone has. Cost O(nnz).
void require_plausible(const SparseModel& model, double bound = 1e-9);

}  // namespace thinwall::dynamics

#pragma once
// The harmonic extension of a field from some nodes of a mesh to all of them.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "linalg/sparse_cholesky.hpp"
#include "mesh/lagrange_nodes.hpp"

namespace thinwall::fem {

/// The extension u of values at given nodes to the others for which ∫ ∇v · ∇u dV = 0 for every v of the elements' order
/// that is zero at the given nodes. Through a thin wall between two sides with given values it is linear.
class HarmonicExtension {
 public:
  /// Factorises the matrix of the free nodes. `nodes`: of straight elements; `given`: true for each node with a value,
  /// of which every connected piece of the mesh must have one. Cost: a factorisation with one row for each free node.
  HarmonicExtension(const mesh::LagrangeNodes& nodes, const std::vector<bool>& given);
  /// The values at all nodes, nodes × m. `values`: nodes × m; the rows of free nodes are not read.
  [[nodiscard]] Eigen::MatrixXd extended(const Eigen::MatrixXd& values) const;

 private:
  std::vector<int> free_;
  linalg::SparseMatrix coupling_;  // free × nodes, zero in the columns of free nodes
  std::optional<linalg::SparseCholesky> factor_;
};

}  // namespace thinwall::fem

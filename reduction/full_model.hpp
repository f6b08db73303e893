#pragma once
// The full model of a part, before its reduction.

#include <Eigen/Core>
#include <vector>

#include "linalg/sparse.hpp"

namespace thinwall::reduction {

/// The matrices of a part, with constraints eliminated, from which every reduction begins.
struct FullModel {
  linalg::SparseMatrix K;        ///< free × free, N/m
  linalg::SparseMatrix M;        ///< free × free, kg, positive definite
  std::vector<int> node_of_row;  ///< for each row the node it belongs to, any numbering
  /// The motions that nothing holds, as independent columns of any length: free × r; empty for a held part. If they are
  /// not known from geometry, rigid_body_modes() finds them.
  Eigen::MatrixXd rigid{};
};

}  // namespace thinwall::reduction

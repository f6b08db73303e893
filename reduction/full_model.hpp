#pragma once
// A part before its reduction.

#include <Eigen/Core>
#include <vector>

#include "linalg/sparse.hpp"

namespace thinwall::reduction {

/// What every reduction begins with. Constraints are eliminated.
struct FullModel {
  linalg::SparseMatrix K;        ///< free × free, N/m
  linalg::SparseMatrix M;        ///< free × free, kg, positive definite
  std::vector<int> node_of_row;  ///< for each row the node it belongs to, any numbering
  /// The motions that nothing holds as columns, of any length, independent: free × r. Empty for a held part. Where they
  /// are not known from geometry: rigid_body_modes().
  Eigen::MatrixXd rigid{};
};

}  // namespace thinwall::reduction

#pragma once
// The symmetric part of a matrix.

#include <Eigen/Core>

namespace thinwall::reduction {

/// The symmetric part (A + Aᵀ)/2 of a square A. Cost O(n²).
[[nodiscard]] inline Eigen::MatrixXd symmetric_part(const Eigen::MatrixXd& A) {
  return 0.5 * (A + A.transpose());
}

}  // namespace thinwall::reduction

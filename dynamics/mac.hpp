#pragma once
// The modal assurance criterion, a measure of how alike mode shapes are.

#include <Eigen/Core>

namespace thinwall::dynamics {

/// The modal assurance criterion |aᵀb|² / (aᵀa bᵀb) of real shapes (Allemang & Brown 1982), columns of `a` × columns of
/// `b`, each entry from 0 to 1; it is 0 for a shape that is zero. Throws InputError unless `a` and `b` have the same
/// number of rows. Cost O(rows · a · b).
[[nodiscard]] Eigen::MatrixXd mac(const Eigen::Ref<const Eigen::MatrixXd>& a,
                                  const Eigen::Ref<const Eigen::MatrixXd>& b);

}  // namespace thinwall::dynamics

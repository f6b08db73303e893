#pragma once
// How alike mode shapes are.

#include <Eigen/Core>

namespace thinwall::dynamics {

/// Modal assurance criterion |aᵀb|² / (aᵀa bᵀb) of real shapes (Allemang & Brown 1982): columns of `a` × columns of
/// `b`, 0 to 1; 0 for a shape that is zero. Both hold the same rows. Throws InputError otherwise. Cost O(rows · a · b).
[[nodiscard]] Eigen::MatrixXd mac(const Eigen::Ref<const Eigen::MatrixXd>& a,
                                  const Eigen::Ref<const Eigen::MatrixXd>& b);

}  // namespace thinwall::dynamics

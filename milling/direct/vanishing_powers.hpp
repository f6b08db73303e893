#pragma once
// A proof of stability that costs less than the eigenvalues.

#include <Eigen/Core>

namespace thinwall::milling {

/// True if the powers M^(2^k) of a square matrix, k up to 24, are seen to shrink: if the Frobenius norm of one is below
/// 0.9, every eigenvalue lies within the unit circle, for |μ|^p ≤ ‖M^p‖. False says nothing: an eigenvalue may lie
/// outside, or so near to the circle (some 1e-6) that round-off would decide, or the norm grew beyond 100 on the way. M
/// is balanced first (Osborne 1960: rows and columns scaled against each other until their norms agree), which keeps
/// the eigenvalues and takes a growth off the powers that is a matter of units. NaN gives false. Cost: a product of
/// matrices a squaring, some ten where the largest |μ| is 1 − 1e-3; a fifth of what the eigenvalues take.
[[nodiscard]] bool powers_vanish(Eigen::MatrixXd M);

}  // namespace thinwall::milling

#pragma once
// The few eigenvalues of a dense complex matrix that exceed a bound.

#include <Eigen/Core>
#include <optional>

namespace thinwall::linalg {

/// Eigenvalues above a bound, and the steps of Arnoldi's process after which they had settled.
struct LargestEigenvalues {
  Eigen::VectorXcd values;
  Eigen::Index steps = 0;
};

/// The eigenvalues of A with |ν| > `least` (≥ 0), in no order, each to about `accuracy` of |ν|: Arnoldi's process with
/// two starting vectors, so that an eigenvalue counts twice where it is double (Ruhe's variant of block Arnoldi, Saad
/// 2003, "Iterative Methods for Sparse Linear Systems", ch. 6.12). The eigenvalues of the projected matrix are compared
/// with those of six steps before, until all above the bound, and the largest one in any case, have settled. The first
/// look at them is at `first_look` steps, 12 at least: most of the time goes into looks, which a matrix like another
/// one needs only near that one's last. Nothing if A is not finite, or if they have not settled in half as many steps
/// as it has rows. The starting vectors are always the same. An eigenvalue whose vector is orthogonal to what they span
/// would be missed, so that the caller must have another way of counting, and of an eigenvalue with more than two
/// vectors two are found. Cost: a product of A with a vector for each of some twenty to forty steps.
[[nodiscard]] std::optional<LargestEigenvalues> largest_eigenvalues(const Eigen::MatrixXcd& A, double least,
                                                                    Eigen::Index first_look = 0,
                                                                    double accuracy = 1e-8);

}  // namespace thinwall::linalg

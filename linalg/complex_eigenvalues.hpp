#pragma once
// Eigenvalues of small complex matrices, many times over.

#include <Eigen/Core>
#include <optional>

namespace thinwall::linalg {

/// All eigenvalues of A, in no order: Hessenberg's form by elimination, then QR steps with Wilkinson's shift on the
/// block that has not split yet (Golub & Van Loan 2013, ch. 7.4), each eigenvalue to round-off of ‖A‖. Nothing if A is
/// not finite or one does not settle in 60 steps. Eigen's ComplexSchur carries the whole triangular matrix along, which
/// eigenvalues alone do not need, and LAPACK's zgeev begins to pay beyond the sizes of a search: at 7 to 13 unknowns
/// this takes less than half of either's time. Cost O(n³).
[[nodiscard]] std::optional<Eigen::VectorXcd> complex_eigenvalues(const Eigen::MatrixXcd& A);

}  // namespace thinwall::linalg

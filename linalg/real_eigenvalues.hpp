#pragma once
// Eigenvalues of large dense real matrices.

#include <Eigen/Core>
#include <optional>

namespace thinwall::linalg {

/// All eigenvalues of a square A, in no order: balanced (Osborne 1960), Hessenberg's form by reflections in blocks,
/// then multishift QR with early deflation (Braman, Byers & Mathias 2002), by LAPACK's dgebal, dgehrd and dhseqr on one
/// thread. Nothing if A is not finite or an eigenvalue does not settle. Eigen's RealSchur, which takes one shift after
/// the other through the whole matrix, needs twice the time at 300 rows and three times at 900; below 150 there is no
/// difference. Looks at interrupts between the steps. Cost some 10 n³.
[[nodiscard]] std::optional<Eigen::VectorXcd> real_eigenvalues(Eigen::MatrixXd A);

}  // namespace thinwall::linalg

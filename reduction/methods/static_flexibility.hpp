#pragma once
// The static flexibility of a part: the inverse of K, or its elastic part if nothing holds the part.

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "linalg/eigenpairs.hpp"
#include "linalg/sparse.hpp"
#include "linalg/sparse_cholesky.hpp"
#include "reduction/full_model.hpp"

namespace thinwall::reduction {

/// The elastic flexibility G (docs/theory/reductions.md, Eq. 5): K⁻¹ of a held part; of a free one, with its rigid-body
/// modes R, RᵀMR = I,
///
///     G = Pᵀ (K + s E Eᵀ)⁻¹ P,     P = I − M R Rᵀ          (inertia relief; Craig & Chang 1977)
///
/// where E has as many unit columns as there are rigid motions, on rows that restrain them, and s is the mean diagonal
/// of K. P brings loads into equilibrium, so that the restraints on E carry no force and G does not depend on E. G = Σ
/// φφᵀ/λ over the elastic modes.
class StaticFlexibility {
 public:
  /// Factorises the part. Throws InputError if full.rigid has another number of rows than K, if its columns depend on
  /// each other, or if K stretches one of them (something holds that motion); NumericalError if K is singular beyond
  /// it. Cost: a factorisation.
  explicit StaticFlexibility(const FullModel& full);

  /// The action of G on the columns of a matrix, sigma 0. It is valid as long as this object. Cost: a solve.
  [[nodiscard]] linalg::ShiftedInverse action() const;

  /// The rigid-body modes R, M-orthonormal: free × r.
  [[nodiscard]] const Eigen::MatrixXd& rigid_modes() const { return R_; }

 private:
  Eigen::MatrixXd R_, MR_;
  std::unique_ptr<linalg::SparseCholesky> factor_;
};

/// The motions without elastic energy, found from the matrices: free × r, M-orthonormal, r = 0 for a held part. They
/// belong to as many of the lowest eigenvalues as lie within 1e-6 of the next above them, or within the round-off of K,
/// 10 ε tr K / tr M; at most twelve are sought (two free pieces). The function is for matrices that come without
/// geometry. Throws NumericalError if the eigen-solver does not converge. Cost: a factorisation of K + αM, α = 1e-8 tr
/// K / tr M, and about ten of its solves.
[[nodiscard]] Eigen::MatrixXd rigid_body_modes(const linalg::SparseMatrix& K, const linalg::SparseMatrix& M,
                                               const std::vector<int>& node_of_row);

}  // namespace thinwall::reduction

#pragma once
// What a static load does to a part, held or free: the inverse of K, or its elastic part where nothing holds K.

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
/// where E holds as many unit columns as there are rigid motions, on rows that restrain them, and s is the mean
/// diagonal of K. P leaves loads in equilibrium, so that what E holds does no work and G does not depend on E. G = Σ
/// φφᵀ/λ over the elastic modes.
class StaticFlexibility {
 public:
  /// Throws InputError if full.rigid has another height than K, depends on itself or is stretched by K (a motion that
  /// something holds), NumericalError if K is singular beyond it. Cost: a factorisation.
  explicit StaticFlexibility(const FullModel& full);

  /// G on the columns of a matrix, sigma 0; valid as long as this object. Cost: a solve.
  [[nodiscard]] linalg::ShiftedInverse action() const;

  /// R, M-orthonormal: free × r.
  [[nodiscard]] const Eigen::MatrixXd& rigid_modes() const { return R_; }

 private:
  Eigen::MatrixXd R_, MR_;
  std::unique_ptr<linalg::SparseCholesky> factor_;
};

/// The motions that cost no energy, found from the matrices: free × r, M-orthonormal, r = 0 for a held part; as many of
/// the lowest eigenvalues as lie within 1e-6 of the next above them, or within the round-off of K, 10 ε tr K / tr M.
/// Looks for at most twelve (two free pieces). For matrices that come without geometry. Throws NumericalError if the
/// eigen-solver does not converge. Cost: a factorisation of K + αM, α = 1e-8 tr K / tr M, and some ten of its solves.
[[nodiscard]] Eigen::MatrixXd rigid_body_modes(const linalg::SparseMatrix& K, const linalg::SparseMatrix& M,
                                               const std::vector<int>& node_of_row);

}  // namespace thinwall::reduction

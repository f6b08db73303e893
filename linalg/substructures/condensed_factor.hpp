#pragma once
// The factor of the inner rows of a matrix, and the matrix condensed to the other rows.

#include <Eigen/Core>
#include <vector>

#include "linalg/large_array.hpp"
#include "linalg/sparse.hpp"
#include "linalg/symbolic_factor.hpp"
#include "linalg/tree_cut.hpp"

namespace thinwall::linalg {

/// A matrix A with the rows i inside and b at its border, eliminated inside:
///
///     A = [A_ii A_ib; A_bi A_bb],    S = A_bb − A_bi A_ii⁻¹ A_ib      the Schur complement (Guyan 1965)
///
/// Both come from one factor of A in which the border is eliminated last: its last block is that of S = L_bb L_bbᵀ.
class CondensedFactor {
 public:
  /// Factorises A: n × n, symmetric positive definite, both triangles; border: its rows b, ascending; node_of_row: the
  /// node of each row in any numbering, none with rows of both kinds. Throws NumericalError if A is not positive
  /// definite or memory lacks. Cost: that of a factor whose last front has as many rows as the border.
  CondensedFactor(const SparseMatrix& A, const std::vector<int>& border, const std::vector<int>& node_of_row);

  /// The Schur complement S in the order of `border`, once; it is empty afterwards.
  [[nodiscard]] Eigen::MatrixXd take_condensed() { return std::move(S_); }
  /// A_ii⁻¹ on the inner rows of B (n × any), zero at the border; what B has there is not looked at.
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& B) const;

 private:
  void condense(const std::vector<int>& border);

  SymbolicFactor L_;
  TreeCut cut_;
  LargeArray<double> values_;
  Eigen::MatrixXd S_;
};

}  // namespace thinwall::linalg

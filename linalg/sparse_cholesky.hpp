#pragma once
// Sparse Cholesky factorisation of a symmetric positive definite matrix, once, for many right-hand sides.

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/error.hpp"
#include "linalg/sparse.hpp"

namespace thinwall::linalg {

/// Limits of a factorisation.
struct FactorOptions {
  /// Compared with the symbolic factor before the numeric one is allocated; 0: core::memory_left_bytes().
  double memory_limit_bytes = 0.0;
};

/// Size of a factor and cost of its factorisation.
struct FactorStatistics {
  double flops = 0.0;       ///< flops of the numeric factorisation
  double nonzeros = 0.0;    ///< entries of the factor L, including the zeros that merged supernodes store
  double bytes = 0.0;       ///< factor with the zeros that supernodes store, its indices and its workspace
  double bytes_held = 0.0;  ///< the same without the workspace, which is given back after the factorisation
  double seconds_ordering = 0.0;
  double seconds_analysis = 0.0;
  double seconds_numeric = 0.0;
};

/// The error of a factor that would exceed the memory limit; nothing was allocated.
class MemoryLimitError : public core::NumericalError {
 public:
  MemoryLimitError(const std::string& message, double needed, double limit)
      : core::NumericalError(message), needed_bytes(needed), limit_bytes(limit) {}
  double needed_bytes = 0.0;
  double limit_bytes = 0.0;
};

/// The factorisation P A Pᵀ = L Lᵀ, made once for many right-hand sides. It is ordered and analysed on the sets of rows
/// with one pattern (pattern_graph()): by minimum_fill_order() up to 1500 sets and by elimination_order() with METIS
/// beyond, then symbolic_factor() with CHOLMOD; the numbers are supernodal_factor()'s. Source and measurements:
/// docs/theory/elements.md.
class SparseCholesky {
 public:
  /// Factorises A: n × n, symmetric positive definite, both triangles stored. node_of_row: the node of each row in any
  /// numbering, used in messages only. Throws NumericalError if A is not positive definite, naming the row and its
  /// node, and MemoryLimitError. Cost: statistics().flops.
  SparseCholesky(const SparseMatrix& A, const std::vector<int>& node_of_row, const FactorOptions& options = {});
  /// Factorises A + b B, such as K − σM, which is not formed where every entry of B lies at one of A. Arguments, errors
  /// and cost as above.
  SparseCholesky(const SparseMatrix& A, double b, const SparseMatrix& B, const std::vector<int>& node_of_row,
                 const FactorOptions& options = {});
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;
  SparseCholesky(const SparseCholesky&) = delete;
  SparseCholesky& operator=(const SparseCholesky&) = delete;

  /// The solution A⁻¹ B for B: n × any. It may be called from several threads at once. Cost 4 nnz(L) flops a column;
  /// sixteen columns take the time of three single ones, because the reading of L counts.
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& B) const;

  /// Size and cost of the factor.
  [[nodiscard]] const FactorStatistics& statistics() const;
  /// Number of rows of the matrix.
  [[nodiscard]] Eigen::Index rows() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace thinwall::linalg

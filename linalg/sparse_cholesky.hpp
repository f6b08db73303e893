#pragma once
// Sparse Cholesky factorisation of a symmetric positive definite matrix, once, for many right-hand sides.

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/error.hpp"
#include "linalg/sparse.hpp"

namespace thinwall::linalg {

/// What a factorisation may use.
struct FactorOptions {
  double memory_limit_bytes = 0.0;  ///< 0: no limit. Compared with the symbolic factor before anything is allocated
};

/// What a factorisation cost.
struct FactorStatistics {
  double flops = 0.0;     ///< of the numeric factorisation
  double nonzeros = 0.0;  ///< of the factor L, relaxed supernodes' zeros included
  double bytes = 0.0;     ///< of the factor with the zeros that supernodes store, its indices and its workspace
  double seconds_ordering = 0.0;
  double seconds_analysis = 0.0;
  double seconds_numeric = 0.0;
};

/// A factor that would exceed the memory limit; nothing was allocated.
class MemoryLimitError : public core::NumericalError {
 public:
  MemoryLimitError(const std::string& message, double needed, double limit)
      : core::NumericalError(message), needed_bytes(needed), limit_bytes(limit) {}
  double needed_bytes = 0.0;
  double limit_bytes = 0.0;
};

/// P A Pᵀ = L Lᵀ on the sets of rows with one pattern (pattern_graph): minimum_fill_order(), beyond 1500 sets
/// elimination_order() with METIS; symbolic_factor() with CHOLMOD, supernodal_factor().
class SparseCholesky {
 public:
  /// A: n × n, symmetric positive definite, both triangles stored. node_of_row: for each row the node it belongs to,
  /// any numbering, for messages. Throws NumericalError if A is not positive definite, naming
  /// the row, and MemoryLimitError. Cost: statistics().flops.
  SparseCholesky(const SparseMatrix& A, const std::vector<int>& node_of_row, const FactorOptions& options = {});
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;
  SparseCholesky(const SparseCholesky&) = delete;
  SparseCholesky& operator=(const SparseCholesky&) = delete;

  /// A⁻¹ B; B: n × any. Cost 4 nnz(L) flops a column; sixteen columns cost what three single ones do. May be called
  /// from several threads at once.
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& B) const;

  /// Size and cost of the factor.
  [[nodiscard]] const FactorStatistics& statistics() const;
  /// Order of the matrix.
  [[nodiscard]] Eigen::Index rows() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace thinwall::linalg

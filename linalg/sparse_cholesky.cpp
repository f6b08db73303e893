#include "linalg/sparse_cholesky.hpp"

#include <chrono>
#include <string>
#include <utility>

#include "core/memory.hpp"
#include "core/units.hpp"
#include "linalg/external_factor.hpp"
#include "linalg/factor_bytes.hpp"
#include "linalg/large_array.hpp"
#include "linalg/ordering.hpp"
#include "linalg/supernodal_factor.hpp"
#include "linalg/supernodal_solve.hpp"
#include "linalg/symbolic_factor.hpp"
#include "linalg/tree_cut.hpp"

namespace thinwall::linalg {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void require_memory(double needed, double limit, Eigen::Index rows) {
  const bool of_process = limit <= 0.0;
  if (of_process) limit = core::memory_left_bytes();
  if (limit <= 0.0 || needed <= limit) return;
  throw MemoryLimitError("the factor of a matrix of " + std::to_string(rows) + " rows needs " +
                             core::readable_text(needed, core::kind::memory) + ", " +
                             (of_process ? "and " + core::memory_left_text()
                                         : "more than the limit of " + core::readable_text(limit, core::kind::memory)),
                         needed, limit);
}

/// True if every entry of B lies at an entry of A; both have ascending rows in their columns.
bool lies_within(const SparseMatrix& B, const SparseMatrix& A) {
  for (Eigen::Index j = 0; j < A.cols(); ++j) {
    SparseMatrix::InnerIterator of_a(A, j);
    for (SparseMatrix::InnerIterator of_b(B, j); of_b; ++of_b) {
      while (of_a && of_a.row() < of_b.row()) ++of_a;
      if (!of_a || of_a.row() != of_b.row()) return false;
    }
  }
  return true;
}

void require_square(const SparseMatrix& A, const std::vector<int>& node_of_row) {
  if (A.rows() == 0 || A.rows() != A.cols() || static_cast<std::size_t>(A.rows()) != node_of_row.size())
    throw core::NumericalError("a factorisation needs a square matrix and a node for each of its rows");
}

}  // namespace

struct SparseCholesky::Impl {
  SymbolicFactor L;
  TreeCut cut;
  LargeArray<double> values;
  FactorStatistics statistics;
  Eigen::Index rows = 0;
  std::unique_ptr<ExternalFactor> external;  // if another engine holds the factor, in place of all above

  void analyse(const SparseMatrix& A) {
    auto start = Clock::now();
    const MatrixGraph graph = pattern_graph(A);
    const std::vector<int> order = least_fill_order(graph);
    statistics.seconds_ordering = seconds_since(start);
    start = Clock::now();
    L = symbolic_factor(graph, order);
    cut = tree_cut(L);
    const FactorCost cost = factor_cost(L);
    statistics.flops = cost.flops;
    statistics.nonzeros = cost.nonzeros;
    statistics.bytes = factor_bytes(L, cut);
    statistics.bytes_held = statistics.bytes - update_bytes(L, cut);
    statistics.seconds_analysis = seconds_since(start);
  }

  void compute(const MatrixSum& sum, const std::vector<int>& node_of_row, const FactorOptions& options) {
    analyse(sum.A);
    require_memory(statistics.bytes, options.memory_limit_bytes, rows);
    const auto start = Clock::now();
    values = LargeArray<double>(L.values());
    const auto failed = supernodal_factor(sum, L, cut, values.data());
    statistics.seconds_numeric = seconds_since(start);
    if (!failed) return;
    const auto row = static_cast<std::size_t>(L.permutation[static_cast<std::size_t>(*failed)]);
    throw core::NumericalError(
        "the matrix is not positive definite at row " + std::to_string(row) + " (node " +
        std::to_string(node_of_row[row]) +
        "): a motion without stiffness, an element turned inside out, or a wall too thin for double "
        "precision");
  }
};

SparseCholesky::SparseCholesky(const SparseMatrix& A, const std::vector<int>& node_of_row, const FactorOptions& options)
    : impl_(std::make_unique<Impl>()) {
  require_square(A, node_of_row);
  impl_->rows = A.rows();
  impl_->external = external_factor(A, options);
  if (impl_->external) {
    impl_->statistics = impl_->external->statistics();
    return;
  }
  impl_->compute({.A = A}, node_of_row, options);
}

SparseCholesky::SparseCholesky(const SparseMatrix& A, double b, const SparseMatrix& B,
                               const std::vector<int>& node_of_row, const FactorOptions& options) {
  if (B.rows() != A.rows() || B.cols() != A.cols())
    throw core::NumericalError("the two matrices whose sum is to be factorised differ in size");
  if (has_factoriser() || !lies_within(B, A)) {
    *this = SparseCholesky(combine(1.0, A, b, B), node_of_row, options);
    return;
  }
  require_square(A, node_of_row);
  impl_ = std::make_unique<Impl>();
  impl_->rows = A.rows();
  impl_->compute({.A = A, .b = b, .B = &B}, node_of_row, options);
}

SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

Eigen::MatrixXd SparseCholesky::solve(const Eigen::Ref<const Eigen::MatrixXd>& B) const {
  if (impl_->external) return impl_->external->solve(B);
  return supernodal_solution(impl_->L, impl_->cut, impl_->values.data(), B);
}
const FactorStatistics& SparseCholesky::statistics() const {
  return impl_->statistics;
}
Eigen::Index SparseCholesky::rows() const {
  return impl_->rows;
}

}  // namespace thinwall::linalg

#include "linalg/sparse_cholesky.hpp"

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>

#include "core/parallel.hpp"
#include "linalg/cholmod.hpp"
#include "linalg/library_threads.hpp"
#include "linalg/ordering.hpp"
#include "linalg/supernodal_solve.hpp"

namespace thinwall::linalg {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

template <class Index>
Supernodes<Index> supernodes(const cholmod_factor& L) {
  return {static_cast<Index>(L.nsuper),    static_cast<const Index*>(L.super), static_cast<const Index*>(L.pi),
          static_cast<const Index*>(L.px), static_cast<const Index*>(L.s),     static_cast<const double*>(L.x)};
}

/// Columns first … first + width − 1 of X = A⁻¹ B (those that there are), permuted on the way in and out.
template <int width, class Index>
void solve_strip(const cholmod_factor& L, const SolvePlan& plan, const Eigen::Ref<const Eigen::MatrixXd>& B,
                 Eigen::Index first, Eigen::MatrixXd& X) {
  const Eigen::Index columns = std::min<Eigen::Index>(width, B.cols() - first);
  const auto* permutation = static_cast<const Index*>(L.Perm);
  Eigen::Matrix<double, width, Eigen::Dynamic> Y(width, B.rows());
  if (columns < width) Y.setZero();
  for (Eigen::Index j = 0; j < columns; ++j) {
    const double* b = B.data() + (first + j) * B.outerStride();
    for (Eigen::Index row = 0; row < B.rows(); ++row) Y(j, row) = b[permutation[row]];
  }
  supernodal_solve<width, Index>(supernodes<Index>(L), plan, Y);
  for (Eigen::Index j = 0; j < columns; ++j) {
    double* x = X.data() + (first + j) * X.outerStride();
    for (Eigen::Index row = 0; row < B.rows(); ++row) x[permutation[row]] = Y(j, row);
  }
}

/// A factor with one width of index.
template <class Index>
struct Factor {
  CholmodFactor<Index> cholmod{CHOLMOD_SUPERNODAL};
  SolvePlan plan;

  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& B) const {
    Eigen::MatrixXd X(B.rows(), B.cols());
    Eigen::Index column = 0;
    for (; column + 16 <= B.cols(); column += 16) solve_strip<16, Index>(*cholmod.L, plan, B, column, X);
    for (; column + 4 < B.cols(); column += 8) solve_strip<8, Index>(*cholmod.L, plan, B, column, X);
    for (; column < B.cols(); column += 4) solve_strip<4, Index>(*cholmod.L, plan, B, column, X);
    return X;
  }
};

template <class Index>
double factor_bytes(const cholmod_factor& L) {
  return 8.0 * static_cast<double>(L.xsize + L.maxcsize) + static_cast<double>(sizeof(Index) * (L.ssize + 8 * L.n));
}

void require_memory(double needed, double limit, Eigen::Index rows) {
  if (limit <= 0.0 || needed <= limit) return;
  throw MemoryLimitError("the factor of a matrix of " + std::to_string(rows) + " rows needs " +
                             std::to_string(needed * 1e-9) + " GB, more than the limit of " +
                             std::to_string(limit * 1e-9) + " GB",
                         needed, limit);
}

}  // namespace

struct SparseCholesky::Impl {
  std::unique_ptr<Factor<int>> narrow;
  std::unique_ptr<Factor<std::int64_t>> wide;
  FactorStatistics statistics;
  Eigen::Index rows = 0;

  /// False if the indices are too narrow.
  template <class Index>
  [[nodiscard]] bool factorise(std::unique_ptr<Factor<Index>>& factor, const SparseMatrix& A,
                               const std::vector<int>& permutation, const std::vector<int>& node_of_row,
                               const FactorOptions& options) {
    auto start = Clock::now();
    factor = std::make_unique<Factor<Index>>();
    CholmodView<Index> view(A);
    if (!factor->cholmod.analyse(view, permutation)) return false;
    statistics.flops = factor->cholmod.common.fl;
    statistics.nonzeros = factor->cholmod.common.lnz;
    statistics.bytes = factor_bytes<Index>(*factor->cholmod.L);
    statistics.seconds_analysis = seconds_since(start);
    require_memory(statistics.bytes, options.memory_limit_bytes, A.rows());
    start = Clock::now();
    // Below some 20 GFlop a second thread gains less than the waiting of BLAS threads for each other costs on a busy
    // machine.
    const LibraryThreads threads(statistics.flops > 2e10 ? core::thread_count() : 1);
    factor->cholmod.factorise(view);
    statistics.seconds_numeric = seconds_since(start);
    const cholmod_factor& L = *factor->cholmod.L;
    if (L.minor < L.n) {
      const auto row = static_cast<std::size_t>(static_cast<const Index*>(L.Perm)[L.minor]);
      throw core::NumericalError("the matrix is not positive definite at row " + std::to_string(row) + " (node " +
                                 std::to_string(node_of_row[row]) +
                                 "): a motion without stiffness, or an element turned inside out");
    }
    factor->plan = solve_plan(supernodes<Index>(L));
    return true;
  }
};

SparseCholesky::SparseCholesky(const SparseMatrix& A, const std::vector<int>& node_of_row, const FactorOptions& options)
    : impl_(std::make_unique<Impl>()) {
  if (A.rows() == 0 || A.rows() != A.cols() || static_cast<std::size_t>(A.rows()) != node_of_row.size())
    throw core::NumericalError("a factorisation needs a square matrix and a node for each of its rows");
  impl_->rows = A.rows();
  const auto start = Clock::now();
  const std::vector<int> permutation = nested_dissection(A, node_of_row);
  impl_->statistics.seconds_ordering = seconds_since(start);
  if (!options.wide_indices && impl_->factorise(impl_->narrow, A, permutation, node_of_row, options)) return;
  impl_->narrow.reset();
  if (!impl_->factorise(impl_->wide, A, permutation, node_of_row, options)) {
    throw core::NumericalError("a factor of " + std::to_string(A.rows()) + " rows is beyond 64-bit indices");
  }
}

SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

Eigen::MatrixXd SparseCholesky::solve(const Eigen::Ref<const Eigen::MatrixXd>& B) const {
  return impl_->narrow ? impl_->narrow->solve(B) : impl_->wide->solve(B);
}
const FactorStatistics& SparseCholesky::statistics() const {
  return impl_->statistics;
}
Eigen::Index SparseCholesky::rows() const {
  return impl_->rows;
}

}  // namespace thinwall::linalg

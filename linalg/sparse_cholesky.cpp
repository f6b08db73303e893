#include "linalg/sparse_cholesky.hpp"

#include <cholmod.h>
#include <metis.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"

extern "C" void openblas_set_num_threads(int);

namespace thinwall::linalg {

namespace {

using Clock = std::chrono::steady_clock;

/// Threads of the libraries below for one call. CHOLMOD's own OpenMP loops ask for four threads whatever the machine
/// has and spin between the small ones: allowing no active level turns them off. BLAS gets `blas` threads: all for a
/// factorisation, whose large supernodes keep them busy, one for a solve, whose small products do not.
struct LibraryThreads {
  explicit LibraryThreads(int blas) {
    omp_set_max_active_levels(0);
    openblas_set_num_threads(blas);
  }
};

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Nested dissection of the graph whose vertices are nodes: a permutation of the rows (new position → old row).
std::vector<int> nested_dissection(const SparseMatrix& A, const std::vector<int>& node_of_row) {
  const auto n = static_cast<std::size_t>(A.rows());
  // Compact node numbers in order of first appearance, and the rows of each.
  std::vector<int> compact(static_cast<std::size_t>(*std::max_element(node_of_row.begin(), node_of_row.end())) + 1, -1);
  std::vector<std::vector<int>> rows_of_node;
  for (std::size_t row = 0; row < n; ++row) {
    int& node = compact[static_cast<std::size_t>(node_of_row[row])];
    if (node < 0) {
      node = static_cast<int>(rows_of_node.size());
      rows_of_node.emplace_back();
    }
    rows_of_node[static_cast<std::size_t>(node)].push_back(static_cast<int>(row));
  }
  const auto nodes = static_cast<idx_t>(rows_of_node.size());
  std::vector<idx_t> start{0};
  std::vector<idx_t> neighbours;
  std::vector<idx_t> weights;
  std::vector<idx_t> last_seen(static_cast<std::size_t>(nodes), -1);
  for (idx_t node = 0; node < nodes; ++node) {
    last_seen[static_cast<std::size_t>(node)] = node;
    for (const int row : rows_of_node[static_cast<std::size_t>(node)]) {
      for (SparseMatrix::InnerIterator it(A, row); it; ++it) {
        const idx_t other = compact[static_cast<std::size_t>(node_of_row[static_cast<std::size_t>(it.row())])];
        if (last_seen[static_cast<std::size_t>(other)] == node) continue;
        last_seen[static_cast<std::size_t>(other)] = node;
        neighbours.push_back(other);
      }
    }
    start.push_back(static_cast<idx_t>(neighbours.size()));
    weights.push_back(static_cast<idx_t>(rows_of_node[static_cast<std::size_t>(node)].size()));
  }
  std::vector<idx_t> order(static_cast<std::size_t>(nodes));
  std::vector<idx_t> position(static_cast<std::size_t>(nodes));
  if (nodes == 1 || neighbours.empty()) {
    for (idx_t i = 0; i < nodes; ++i) order[static_cast<std::size_t>(i)] = i;
  } else {
    idx_t options[METIS_NOPTIONS];
    METIS_SetDefaultOptions(options);
    options[METIS_OPTION_SEED] = 1;
    idx_t count = nodes;
    const int status =
        METIS_NodeND(&count, start.data(), neighbours.data(), weights.data(), options, order.data(), position.data());
    if (status != METIS_OK)
      throw core::NumericalError("METIS could not order a graph of " + std::to_string(nodes) + " nodes");
  }
  std::vector<int> permutation;
  permutation.reserve(n);
  for (const idx_t node : order) {
    const auto& rows = rows_of_node[static_cast<std::size_t>(node)];
    permutation.insert(permutation.end(), rows.begin(), rows.end());
  }
  return permutation;
}

/// A view of A as CHOLMOD sees it: lower triangle of a symmetric matrix, nothing copied.
cholmod_sparse view(const SparseMatrix& A) {
  cholmod_sparse S{};
  S.nrow = static_cast<std::size_t>(A.rows());
  S.ncol = static_cast<std::size_t>(A.cols());
  S.nzmax = static_cast<std::size_t>(A.nonZeros());
  S.p = const_cast<int*>(A.outerIndexPtr());
  S.i = const_cast<int*>(A.innerIndexPtr());
  S.x = const_cast<double*>(A.valuePtr());
  S.stype = -1;
  S.itype = CHOLMOD_INT;
  S.xtype = CHOLMOD_REAL;
  S.dtype = CHOLMOD_DOUBLE;
  S.sorted = 1;
  S.packed = 1;
  return S;
}

cholmod_dense view(const Eigen::Ref<const Eigen::MatrixXd>& B) {
  cholmod_dense D{};
  D.nrow = static_cast<std::size_t>(B.rows());
  D.ncol = static_cast<std::size_t>(B.cols());
  D.d = static_cast<std::size_t>(B.outerStride());
  D.nzmax = D.d * D.ncol;
  D.x = const_cast<double*>(B.data());
  D.xtype = CHOLMOD_REAL;
  D.dtype = CHOLMOD_DOUBLE;
  return D;
}

/// CHOLMOD's workspace and a factor, freed together.
struct Factor {
  mutable cholmod_common common{};
  cholmod_factor* L = nullptr;

  Factor() {
    cholmod_start(&common);
    common.print = 0;
    common.try_catch = 1;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    common.postorder = 1;
  }
  ~Factor() {
    cholmod_free_factor(&L, &common);
    cholmod_finish(&common);
  }
  Factor(const Factor&) = delete;
  Factor& operator=(const Factor&) = delete;

  void factorise(const SparseMatrix& A, const std::vector<int>& node_of_row, FactorStatistics& statistics) {
    if (A.rows() == 0 || A.rows() != A.cols() || static_cast<std::size_t>(A.rows()) != node_of_row.size()) {
      throw core::NumericalError("a factorisation needs a square matrix and a node for each of its rows");
    }
    cholmod_sparse S = view(A);
    auto start = Clock::now();
    std::vector<int> permutation = nested_dissection(A, node_of_row);
    L = cholmod_analyze_p(&S, permutation.data(), nullptr, 0, &common);
    if (common.status == CHOLMOD_TOO_LARGE) {
      throw core::NumericalError("a factor of " + std::to_string(A.rows()) +
                                 " rows is beyond 32-bit indices: use larger elements or a lower order");
    }
    if (L == nullptr)
      throw core::NumericalError("out of memory while analysing a matrix of " + std::to_string(A.rows()) + " rows");
    statistics.flops = common.fl;
    statistics.nonzeros = common.lnz;
    statistics.seconds_ordering = seconds_since(start);
    start = Clock::now();
    // Below some 20 GFlop a second thread gains less than the waiting of BLAS threads for each other costs on a busy
    // machine.
    const LibraryThreads threads(statistics.flops > 2e10 ? core::thread_count() : 1);
    cholmod_factorize(&S, L, &common);
    statistics.seconds_numeric = seconds_since(start);
    if (common.status < CHOLMOD_OK && common.status != CHOLMOD_OUT_OF_MEMORY) {
      throw core::NumericalError("CHOLMOD could not factor a matrix of " + std::to_string(A.rows()) + " rows (status " +
                                 std::to_string(common.status) + ")");
    }
    if (common.status == CHOLMOD_OUT_OF_MEMORY) {
      throw core::NumericalError("out of memory in the factorisation of " + std::to_string(A.rows()) +
                                 " rows (factor of " + std::to_string(statistics.nonzeros * 8e-9) +
                                 " GB): use larger elements");
    }
  }

  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& B) const {
    const LibraryThreads threads(1);
    cholmod_dense D = view(B);
    cholmod_dense* X = cholmod_solve(CHOLMOD_A, L, &D, &common);
    if (X == nullptr)
      throw core::NumericalError("out of memory in a solve with " + std::to_string(B.cols()) + " right-hand sides");
    Eigen::MatrixXd result = Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(X->x), B.rows(), B.cols());
    cholmod_free_dense(&X, &common);
    return result;
  }
};

}  // namespace

struct SparseCholesky::Impl {
  Factor factor;
  FactorStatistics statistics;
  Eigen::Index rows = 0;
};

SparseCholesky::SparseCholesky(const SparseMatrix& A, const std::vector<int>& node_of_row)
    : impl_(std::make_unique<Impl>()) {
  impl_->rows = A.rows();
  impl_->factor.common.supernodal = CHOLMOD_SUPERNODAL;
  impl_->factor.common.final_ll = 1;
  impl_->factor.factorise(A, node_of_row, impl_->statistics);
  if (impl_->factor.common.status == CHOLMOD_NOT_POSDEF || impl_->factor.L->minor < impl_->factor.L->n) {
    const auto* permutation = static_cast<const int*>(impl_->factor.L->Perm);
    const int row = permutation[impl_->factor.L->minor];
    throw core::NumericalError("the matrix is not positive definite at row " + std::to_string(row) + " (node " +
                               std::to_string(node_of_row[static_cast<std::size_t>(row)]) +
                               "): a motion without stiffness, or an element turned inside out");
  }
}

SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

Eigen::MatrixXd SparseCholesky::solve(const Eigen::Ref<const Eigen::MatrixXd>& B) const {
  return impl_->factor.solve(B);
}
const FactorStatistics& SparseCholesky::statistics() const {
  return impl_->statistics;
}
Eigen::Index SparseCholesky::rows() const {
  return impl_->rows;
}

struct SparseIndefinite::Impl {
  Factor factor;
  FactorStatistics statistics;
  SparseMatrix A;
};

SparseIndefinite::SparseIndefinite(const SparseMatrix& A, const std::vector<int>& node_of_row)
    : impl_(std::make_unique<Impl>()) {
  impl_->A = A;
  impl_->factor.common.supernodal = CHOLMOD_SIMPLICIAL;
  impl_->factor.common.final_ll = 0;
  impl_->factor.factorise(A, node_of_row, impl_->statistics);
}

SparseIndefinite::~SparseIndefinite() = default;

std::optional<int> SparseIndefinite::negative_eigenvalues() const {
  const cholmod_factor& L = *impl_->factor.L;
  if (L.minor < L.n) return std::nullopt;
  const auto* column = static_cast<const int*>(L.p);
  const auto* value = static_cast<const double*>(L.x);
  int negative = 0;
  for (std::size_t j = 0; j < L.n; ++j) {
    const double pivot = value[column[j]];  // the diagonal of D stands first in each column
    if (pivot == 0.0 || !std::isfinite(pivot)) return std::nullopt;
    if (pivot < 0.0) ++negative;
  }
  return negative;
}

SparseIndefinite::Solution SparseIndefinite::solve(const Eigen::Ref<const Eigen::MatrixXd>& B) const {
  Solution solution;
  solution.X = impl_->factor.solve(B);
  const Eigen::MatrixXd correction = impl_->factor.solve(B - impl_->A * solution.X);
  solution.X += correction;
  const Eigen::MatrixXd residual = B - impl_->A * solution.X;
  for (Eigen::Index j = 0; j < B.cols(); ++j) {
    const double relative = residual.col(j).norm() / B.col(j).norm();
    if (std::isnan(solution.relative_residual)) break;
    if (!(relative <= solution.relative_residual)) solution.relative_residual = relative;
  }
  return solution;
}

std::optional<int> count_eigenvalues_below(const SparseMatrix& K, const SparseMatrix& M, double sigma,
                                           const std::vector<int>& node_of_row) {
  return SparseIndefinite(combine(1.0, K, -sigma, M), node_of_row).negative_eigenvalues();
}

}  // namespace thinwall::linalg

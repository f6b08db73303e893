#include "linalg/sparse_indefinite.hpp"

#include <cmath>
#include <string>

#include "core/error.hpp"
#include "linalg/cholmod.hpp"
#include "linalg/library_threads.hpp"
#include "linalg/ordering.hpp"

namespace thinwall::linalg {

namespace {

/// CHOLMOD's description of the dense matrix B; nothing is copied, so that B must outlive it.
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

}  // namespace

struct SparseIndefinite::Impl {
  // The simplicial method makes L D Lᵀ, whose D shows the inertia; CHOLMOD's supernodal method makes L Lᵀ only and
  // would stop at the first negative pivot.
  CholmodFactor factor{CHOLMOD_SIMPLICIAL};
  SparseMatrix A;

  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& B) const {
    const LibraryThreads threads(1);
    cholmod_dense D = view(B);
    cholmod_dense* X = cholmod_solve(CHOLMOD_A, factor.L, &D, &factor.common);
    if (X == nullptr)
      throw core::NumericalError("out of memory in a solve with " + std::to_string(B.cols()) + " right-hand sides");
    Eigen::MatrixXd result = Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(X->x), B.rows(), B.cols());
    cholmod_free_dense(&X, &factor.common);
    return result;
  }
};

SparseIndefinite::SparseIndefinite(const SparseMatrix& A, const std::vector<int>& node_of_row)
    : impl_(std::make_unique<Impl>()) {
  impl_->A = A;
  cholmod_sparse view = cholmod_view(impl_->A);
  impl_->factor.analyse(&view, nested_dissection(A, node_of_row));
  const LibraryThreads threads(1);
  impl_->factor.factorise(&view);
}

SparseIndefinite::~SparseIndefinite() = default;

std::optional<int> SparseIndefinite::negative_eigenvalues() const {
  const cholmod_factor& L = *impl_->factor.L;
  if (L.minor < L.n) return std::nullopt;
  const auto* column = static_cast<const int*>(L.p);
  const auto* value = static_cast<const double*>(L.x);
  int negative = 0;
  for (std::size_t j = 0; j < L.n; ++j) {
    const double pivot = value[column[j]];  // CHOLMOD stores the entry of D first in each column of L
    if (pivot == 0.0 || !std::isfinite(pivot)) return std::nullopt;
    if (pivot < 0.0) ++negative;
  }
  return negative;
}

SparseIndefinite::Solution SparseIndefinite::solve(const Eigen::Ref<const Eigen::MatrixXd>& B) const {
  Solution solution;
  solution.X = impl_->solve(B);
  // One step of iterative refinement recovers digits that elimination without pivoting has lost; the residual tells
  // whether it was enough.
  const Eigen::MatrixXd correction = impl_->solve(B - impl_->A * solution.X);
  solution.X += correction;
  const Eigen::MatrixXd residual = B - impl_->A * solution.X;
  for (Eigen::Index j = 0; j < B.cols(); ++j) {
    const double relative = residual.col(j).norm() / B.col(j).norm();
    // NaN in any column must show in the maximum, which plain comparisons would hide.
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

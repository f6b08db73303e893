#include "linalg/block_lanczos.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <utility>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/memory.hpp"
#include "linalg/inverse_iteration.hpp"
#include "linalg/tall.hpp"

namespace thinwall::linalg {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// An M-orthonormal basis W Z of the span of the columns of W, (WZ)ᵀM(WZ) = I, with W = (WZ) B. Both follow from the
/// Gram matrix alone, by G = WᵀMW = D UΛUᵀ D, where D scales G to a unit diagonal. Z has fewer columns than W if
/// columns of W depend on each other or are no longer than `shortest`. The eigenvalues of G instead of its Cholesky
/// factor reveal that dependence, and need the long vectors in one product only.
struct Orthonormal {
  MatrixXd Z;
  MatrixXd B;
  double smallest = 0.0;  // smallest entry of Λ
};

Orthonormal orthonormal(const MatrixXd& G, double shortest) {
  constexpr double dependent = 1e-24;  // a direction shorter than 1e-12 of the columns is their round-off
  const VectorXd length = G.diagonal().cwiseMax(0.0).cwiseSqrt();
  const VectorXd scale = length.unaryExpr([&](double l) { return l > shortest ? 1.0 / l : 0.0; });
  const MatrixXd scaled = scale.asDiagonal() * G * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(MatrixXd(0.5 * (scaled + scaled.transpose())));
  const VectorXd& squares = eigen.eigenvalues();  // ascending
  const Index kept = (squares.array() > dependent).count();
  const auto U = eigen.eigenvectors().rightCols(kept);
  const VectorXd root = squares.tail(kept).cwiseSqrt();
  return {scale.asDiagonal() * U * root.cwiseInverse().asDiagonal(),
          root.asDiagonal() * U.transpose() * length.asDiagonal(), squares(0)};
}

/// The M-orthonormal part Q of a block W that lies outside of the basis V, with M Q, and B of W = V VᵀMW + Q B.
struct Block {
  MatrixXd Q;
  MatrixXd MQ;
  MatrixXd B;
};

/// The state of the iteration: the basis V, the projection T of the operator on it, and what an image has outside of
/// the basis.
struct Krylov {
  const SparseMatrix& M;
  const ShiftedInverse& inverse;
  MatrixXd V{};  // n × capacity; the first `columns` columns hold the basis
  MatrixXd T{};  // VᵀMAV, upper triangle
  Index columns = 0;
  std::array<MatrixXd, 2> recent{};  // M times the last two blocks of V
  std::mt19937_64 random{20190801};

  [[nodiscard]] auto basis() const { return V.leftCols(columns); }

  /// Makes room for so many columns, for which both the old and the new basis are held.
  void widen(Index capacity) {
    core::require_memory(8.0 * static_cast<double>(M.rows() * capacity), "a basis of " + std::to_string(capacity) +
                                                                             " vectors of " + std::to_string(M.rows()) +
                                                                             " entries for the modes");
    V.conservativeResize(Eigen::NoChange, capacity);
  }

  void append(const Block& block) {
    const Index after = columns + block.Q.cols();
    if (after > V.cols()) widen(std::max(2 * V.cols(), after));
    V.middleCols(columns, block.Q.cols()) = block.Q;
    columns = after;
    recent[0] = std::exchange(recent[1], block.MQ);
  }

  MatrixXd random_columns(Index count) {
    return MatrixXd::NullaryExpr(M.rows(), count, [&] { return std::ldexp(static_cast<double>(random()), -63) - 1.0; });
  }

  /// Subtracts from W its M-projection on the last two blocks of the basis. In exact arithmetic the three-term
  /// recurrence leaves an image parts in no other block. The coefficients VᵀMW are added to H.
  void take_out_recent(MatrixXd& W, MatrixXd& H) const {
    Index end = columns;
    for (const MatrixXd* MQ : {&recent[1], &recent[0]}) {
      if (MQ->cols() == 0) continue;
      end -= MQ->cols();
      const MatrixXd C = tall_gram(*MQ, W);
      tall_subtract(W, V.middleCols(end, MQ->cols()), C);
      H.middleRows(end, MQ->cols()) += C;
    }
  }

  /// The part of W that lies M-orthogonal to the basis, orthonormalised, by classical Gram-Schmidt; H receives VᵀMW.
  /// The two blocks of the recurrence are taken out first. Round-off brings back parts of the whole basis, which would
  /// lead to spurious copies of converged pairs; every pass therefore projects on all of V, and passes are repeated
  /// until the coefficients that a pass finds are below 1e-10.
  Block outside(MatrixXd W, MatrixXd& H) const {
    H = MatrixXd::Zero(columns, W.cols());
    take_out_recent(W, H);
    MatrixXd MW = symmetric_product(M, W);
    MatrixXd G = tall_gram(W, MW);
    // A column that keeps only 1e-14 of its length outside of the basis is round-off of the projection and no direction
    // of its own.
    double shortest = 1e-14 * std::sqrt((G.diagonal().transpose() + H.colwise().squaredNorm()).maxCoeff());
    MatrixXd B = MatrixXd::Identity(W.cols(), W.cols());
    bool clean = false;
    for (int pass = 0; pass < 6 && W.cols() > 0 && !clean; ++pass) {
      const Orthonormal next = orthonormal(G, shortest);
      const MatrixXd C = tall_gram(basis(), MW) * next.Z;
      W = tall_product(W, next.Z);
      tall_subtract(W, basis(), C);
      B = next.B * B;
      H += C * B;
      clean = C.size() == 0 || C.cwiseAbs().maxCoeff() < 1e-10;
      MW = symmetric_product(M, W);
      G = tall_gram(W, MW);
      // From the second pass on the columns come in with length one. A column that loses all but 1e-3 of it consisted
      // of parts of the basis that round-off had brought back.
      shortest = 1e-3;
    }
    if (W.cols() == 0) return {W, MW, B};
    const Orthonormal last = orthonormal(G, shortest);
    return {tall_product(W, last.Z), tall_product(MW, last.Z), last.B * B};
  }

  /// Makes one step of the iteration: the block joins the basis, A is applied to it and projected; returns the next
  /// block.
  Block step(const Block& block) {
    core::check_interrupt();
    append(block);
    MatrixXd H;
    // The last orthonormalisation has formed M Q, so that A Q = (K−σM)⁻¹ (M Q) needs no product with M.
    Block next = outside(inverse.apply(block.MQ), H);
    T.conservativeResize(columns, columns);
    T.rightCols(block.Q.cols()) = H;
    return next;
  }

  /// A block of `count` random M-orthonormal directions outside of the basis, in the range of A.
  Block random_block(Index count) {
    MatrixXd unused;
    return outside(inverse.apply(symmetric_product(M, random_columns(count))), unused);
  }

  /// A block that begins with directions near the wanted ones. Random directions in the range of A fill it up to a
  /// multiple of eight, which a solve takes at once: they bring in what the given ones may lack.
  Block block_from(const MatrixXd& start) {
    constexpr Index multiple = 8, fewest = 4;
    const Index whole = std::min(M.rows(), (start.cols() + fewest + multiple - 1) / multiple * multiple);
    const Index given = std::min(start.cols(), std::max<Index>(0, whole - fewest));
    MatrixXd W(M.rows(), whole), unused;
    W << start.leftCols(given), inverse.apply(symmetric_product(M, random_columns(whole - given)));
    return outside(std::move(W), unused);
  }
};

/// The eigenpairs of the projected operator T, which approximate those of the operator.
struct Ritz {
  VectorXd theta;     // descending, so that λ = σ + 1/θ ascends
  MatrixXd S;         // the eigenvectors of T as columns
  VectorXd residual;  // ‖B s_last‖ / |θ|, the inverse residual
};

/// The Ritz pairs of T (columns × columns, upper triangle) with B of the block that follows the basis.
Ritz ritz_pairs(const MatrixXd& T, const MatrixXd& B) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(MatrixXd(T.selfadjointView<Eigen::Upper>()));
  Ritz ritz{eigen.eigenvalues().reverse(), eigen.eigenvectors().rowwise().reverse(), {}};
  const VectorXd outside = (B * ritz.S.bottomRows(B.cols())).colwise().norm().transpose();
  ritz.residual = outside.cwiseQuotient(ritz.theta.cwiseAbs().cwiseMax(1e-300));
  return ritz;
}

/// Number of the leading pairs that make up the result, or −1 if it is not known yet or they have not all converged. If
/// all pairs up to lambda_max are wanted, one converged pair beyond it must be seen: the pairs converge from σ upwards,
/// so that then none below it is missed.
Index finished(const Ritz& ritz, const BlockLanczosOptions& options, double sigma, bool exhausted) {
  const Index have = ritz.theta.size();
  Index converged = 0;
  while (converged < have && ritz.theta(converged) > 0.0 && ritz.residual(converged) <= options.tolerance) ++converged;
  if (options.lambda_max <= 0.0) return converged >= options.count ? options.count : -1;
  for (Index k = 0; k < converged; ++k) {
    if (sigma + 1.0 / ritz.theta(k) > options.lambda_max) return k;  // pair k lies beyond, so that no pair is missed
  }
  return exhausted && converged == have ? converged : -1;
}

/// Number of columns of a block. A solve of fewer than eight columns costs hardly less than one of eight; many more
/// than eight enlarge the basis faster than they converge. From 64 pairs on, where the basis is large in any case,
/// sixteen need fewer passes over the factor.
int block_width(const BlockLanczosOptions& options, Index rows) {
  const int wanted = options.block > 0 ? options.block : options.count < 64 ? 8 : 16;
  return static_cast<int>(std::min<Index>(wanted, rows));
}

}  // namespace

Eigenpairs block_lanczos(const SparseMatrix& M, const ShiftedInverse& inverse, const BlockLanczosOptions& options) {
  const Index n = M.rows();
  const Index width = block_width(options, n);
  Krylov krylov{.M = M, .inverse = inverse};
  // Columns that are not reached are never touched, so that room for many costs nothing.
  krylov.V.resize(n, std::min(n, options.lambda_max > 0.0 ? 8 * width : 2 * options.count + 12 * width));
  core::want_large_pages(krylov.V.data(), sizeof(double) * static_cast<std::size_t>(krylov.V.size()));
  Eigenpairs pairs;
  pairs.status = EigenStatus::not_converged;
  // Fewer columns than wanted pairs cannot hold them, so that the first check waits for `count` columns.
  Index next_check = options.lambda_max > 0.0 ? 1 : options.count;
  Block block = options.start.cols() > 0 ? krylov.block_from(options.start) : krylov.random_block(width);
  // The Ritz pairs of given directions may have converged before the random ones have shown what these lack.
  if (options.start.cols() > 0) next_check = std::max(next_check, block.Q.cols() + 1);
  while (pairs.status != EigenStatus::converged && block.Q.cols() > 0) {
    block = krylov.step(block);
    const MatrixXd B = block.B;
    // If the images bring no new direction, the span of the basis is invariant. The iteration goes on with a random
    // direction outside of it, because an eigenvalue may have a multiplicity above the width of a block.
    if (block.Q.cols() == 0 && krylov.columns < n) block = krylov.random_block(1);
    const bool exhausted = block.Q.cols() == 0;
    if (krylov.columns < next_check && !exhausted) continue;
    // The dense eigenproblem of T costs O(columns³): it is solved again only when the basis has grown by a twelfth.
    next_check = krylov.columns + krylov.columns / 12;
    const Ritz ritz = ritz_pairs(krylov.T, B);
    const Index wanted = finished(ritz, options, inverse.sigma, exhausted);
    if (wanted < 0 && !exhausted) continue;
    // When the range of the inverse is exhausted, the pairs that have converged are returned all the same.
    const Index kept = wanted >= 0 ? wanted : (ritz.residual.array() <= options.tolerance).count();
    if (wanted >= 0) pairs.status = EigenStatus::converged;
    pairs.lambda = inverse.sigma + ritz.theta.head(kept).array().inverse();
    pairs.Phi = tall_product(krylov.basis(), ritz.S.leftCols(kept));
  }
  if (pairs.lambda.size() > 0) (void)inverse_iteration(M, inverse, pairs);
  // If the shift coincides with an eigenvalue, round-off along its vector swamps all other pairs; the residual
  // estimated from T does not show it, the measured one does.
  const double most = std::max(1e-6, 2.0 * options.tolerance);
  if (pairs.inverse_residual.size() > 0 && !(pairs.inverse_residual.maxCoeff() < most)) {
    pairs.status = EigenStatus::not_converged;
  }
  return pairs;
}

}  // namespace thinwall::linalg

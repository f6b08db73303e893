#pragma once
// Products with tall, narrow blocks of vectors (many rows, few columns), on all threads.
//
// Rows are cut into pieces whose number does not depend on the number of threads, and partial sums are added in the
// order of the pieces: results are the same bit by bit for any number of threads.

#include <Eigen/Core>

#include "linalg/sparse.hpp"

namespace thinwall::linalg {

/// The product A X for a symmetric A of which both triangles are stored; A: n × n, X: n × any. Cost 2 nnz flops a
/// column.
[[nodiscard]] Eigen::MatrixXd symmetric_product(const SparseMatrix& A, const Eigen::Ref<const Eigen::MatrixXd>& X);

/// The product Vᵀ W; V: n × m, W: n × k. Cost 2 n m k flops.
[[nodiscard]] Eigen::MatrixXd tall_gram(const Eigen::Ref<const Eigen::MatrixXd>& V,
                                        const Eigen::Ref<const Eigen::MatrixXd>& W);

/// W ← W − V C; V: n × m, C: m × k, W: n × k.
void tall_subtract(Eigen::Ref<Eigen::MatrixXd> W, const Eigen::Ref<const Eigen::MatrixXd>& V, const Eigen::MatrixXd& C);

/// The product V C; V: n × m, C: m × k. Cost 2 n m k flops.
[[nodiscard]] Eigen::MatrixXd tall_product(const Eigen::Ref<const Eigen::MatrixXd>& V, const Eigen::MatrixXd& C);

}  // namespace thinwall::linalg

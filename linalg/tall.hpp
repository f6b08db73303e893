#pragma once
// Products with tall, narrow blocks of vectors, on all threads.
//
// Rows are cut into pieces whose number does not depend on the threads, and partial sums are added in the order of the
// pieces: results are the same for any number of threads, bit by bit.

#include <Eigen/Core>

#include "linalg/sparse.hpp"

namespace thinwall::linalg {

/// A X for a symmetric A stored whole; A: n × n, X: n × any. Cost 2 nnz flops a column.
[[nodiscard]] Eigen::MatrixXd symmetric_product(const SparseMatrix& A, const Eigen::Ref<const Eigen::MatrixXd>& X);

/// Vᵀ W; V: n × m, W: n × k.
[[nodiscard]] Eigen::MatrixXd tall_gram(const Eigen::Ref<const Eigen::MatrixXd>& V,
                                        const Eigen::Ref<const Eigen::MatrixXd>& W);

/// W ← W − V C; V: n × m, C: m × k, W: n × k.
void tall_subtract(Eigen::Ref<Eigen::MatrixXd> W, const Eigen::Ref<const Eigen::MatrixXd>& V, const Eigen::MatrixXd& C);

/// V C; V: n × m, C: m × k.
[[nodiscard]] Eigen::MatrixXd tall_product(const Eigen::Ref<const Eigen::MatrixXd>& V, const Eigen::MatrixXd& C);

}  // namespace thinwall::linalg

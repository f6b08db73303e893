#pragma once
// The triangular factor of a matrix with many more rows than columns, as least squares over measured lines have.

#include <Eigen/Core>

namespace thinwall::linalg {

/// The first `columns` rows of Qᵀ A, with A = [A₁ A₂] and A₁ = Q R its first `columns` columns: [R Qᵀ A₂]. The x that
/// minimises ‖A₁ x − A₂‖ follows from R x = Qᵀ A₂, and with `columns` all of A the result is its triangular factor.
///
/// Pieces of the rows are reduced to triangles by Householder reflections, and these, one above the other, likewise
/// (tall and skinny QR: Demmel, Grigori, Hoemmen and Langou 2012, section 2), because a piece stays in the cache, and
/// on all threads. The pieces follow from the shape alone, so that results do not depend on the number of threads.
/// Errors are those of Householder's reflections of A, whatever its condition. A: rows × any. Returns
/// columns × columns of A. Throws InputError if there are fewer rows than `columns`, and Interrupted. Cost: 2.4 rows
/// columns² flops for R.
[[nodiscard]] Eigen::MatrixXd tall_triangle(const Eigen::MatrixXd& A, Eigen::Index columns);

}  // namespace thinwall::linalg

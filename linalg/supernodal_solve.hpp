#pragma once
// Solutions with a supernodal factor for several right-hand sides at once, on all threads.

#include <Eigen/Core>

#include "linalg/symbolic_factor.hpp"
#include "linalg/tree_cut.hpp"

namespace thinwall::linalg {

/// X ← L⁻ᵀ L⁻¹ X in place, rows in new positions. values: those of L in the layout of SymbolicFactor, lower triangles.
/// X: `width` × n column-major, so that the right-hand sides of a row lie side by side; width is 4, 8, 12 or 16.
/// CHOLMOD's solve is not used because the time goes into reading L from memory: this function reads it once a sweep
/// for all right-hand sides, from all threads. Cost 4 nnz(L) flops a right-hand side.
template <int width>
void supernodal_solve(const SymbolicFactor& L, const TreeCut& cut, const double* values,
                      Eigen::Matrix<double, width, Eigen::Dynamic>& X);

/// The solution A⁻¹ B for B: n × any, rows in the order of A, by supernodal_solve() on strips of up to sixteen columns.
[[nodiscard]] Eigen::MatrixXd supernodal_solution(const SymbolicFactor& L, const TreeCut& cut, const double* values,
                                                  const Eigen::Ref<const Eigen::MatrixXd>& B);

}  // namespace thinwall::linalg

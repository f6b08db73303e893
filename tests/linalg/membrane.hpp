#pragma once
// The membrane of grid_problem.hpp ready for an eigen-solution, and what is asked of the pairs found.

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "linalg/eigenpairs.hpp"
#include "linalg/sparse_cholesky.hpp"
#include "tests/linalg/grid_problem.hpp"

namespace thinwall::linalg {

/// A membrane (or several) with the inverse of its stiffness, shifted by σ.
struct Membrane {
  GridProblem grid;
  SparseCholesky factor;
  ShiftedInverse inverse;

  explicit Membrane(GridProblem problem, double sigma = 0.0)
      : grid(std::move(problem)), factor(grid.K, -sigma, grid.M, grid.node_of_row) {
    inverse = {[this](const Eigen::Ref<const Eigen::MatrixXd>& B) { return factor.solve(B); }, sigma};
  }
};

inline double worst_lambda(const Eigenpairs& pairs, const std::vector<double>& exact) {
  double worst = 0.0;
  for (Eigen::Index k = 0; k < pairs.lambda.size(); ++k) {
    const double expected = exact[static_cast<std::size_t>(k)];
    worst = std::max(worst, std::abs(pairs.lambda(k) - expected) / expected);
  }
  return worst;
}

/// Largest entry of ΦᵀMΦ − I.
inline double orthogonality(const SparseMatrix& M, const Eigenpairs& pairs) {
  const Eigen::Index n = pairs.Phi.cols();
  return (pairs.Phi.transpose() * (M * pairs.Phi) - Eigen::MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff();
}

}  // namespace thinwall::linalg

#pragma once
// A membrane on a square grid of bilinear elements: sparse, and known in closed form.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "linalg/sparse.hpp"

namespace thinwall::linalg {

/// K φ = λ M φ of the fixed membrane: with the one-dimensional K₁ = tridiag(−1, 2, −1)/h, M₁ = h tridiag(1, 4, 1)/6 the
/// matrices are K = K₁⊗M₁ + M₁⊗K₁, M = M₁⊗M₁, and λ_ij = λ_i + λ_j, λ_i = 6/h² (1 − cos iπh)/(2 + cos iπh). All with i
/// ≠ j are double.
struct GridProblem {
  SparseMatrix K;
  SparseMatrix M;
  std::vector<int> node_of_row;
  std::vector<double> lambda;  ///< all, ascending
};

inline GridProblem grid_problem(int n) {
  const double h = 1.0 / (n + 1);
  const auto k1 = [h](int d) { return (d == 0 ? 2.0 : -1.0) / h; };
  const auto m1 = [h](int d) { return h * (d == 0 ? 4.0 : 1.0) / 6.0; };
  GridProblem problem;
  std::vector<Eigen::Triplet<double>> k;
  std::vector<Eigen::Triplet<double>> m;
  for (int row = 0; row < n * n; ++row) {
    problem.node_of_row.push_back(row);
    for (int di = -1; di <= 1; ++di) {
      for (int dj = -1; dj <= 1; ++dj) {
        const int i = row / n + di;
        const int j = row % n + dj;
        if (i < 0 || i >= n || j < 0 || j >= n) continue;
        k.emplace_back(row, i * n + j, k1(di) * m1(dj) + m1(di) * k1(dj));
        m.emplace_back(row, i * n + j, m1(di) * m1(dj));
      }
    }
  }
  problem.K.resize(n * n, n * n);
  problem.M.resize(n * n, n * n);
  problem.K.setFromTriplets(k.begin(), k.end());
  problem.M.setFromTriplets(m.begin(), m.end());
  std::vector<double> line;
  for (int i = 1; i <= n; ++i) {
    const double c = std::cos(i * std::numbers::pi * h);
    line.push_back(6.0 / (h * h) * (1.0 - c) / (2.0 + c));
  }
  for (const double a : line) {
    for (const double b : line) problem.lambda.push_back(a + b);
  }
  std::sort(problem.lambda.begin(), problem.lambda.end());
  return problem;
}

}  // namespace thinwall::linalg

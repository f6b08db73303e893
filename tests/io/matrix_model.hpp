#pragma once
// An imported component for the tests of matrix files: held springs and masses with numbers that fill a double.

#include <random>

#include "dynamics/sparse_model.hpp"

namespace thinwall::io::test {

/// Nodes 101 … with six components each, chained by random positive semi-definite 12 × 12 blocks, two amplitudes.
inline dynamics::SparseModel matrix_model(int nodes, bool damped) {
  std::mt19937 random(31);
  std::normal_distribution<double> normal;
  const auto gram = [&](Eigen::Index n, double size) {
    const Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return normal(random); });
    const Eigen::MatrixXd P = size * (A.transpose() * A);
    return Eigen::MatrixXd(0.5 * (P + P.transpose()));
  };
  const Eigen::Index n = 6 * nodes + 2;
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n), M = Eigen::MatrixXd::Zero(n, n);
  dynamics::SparseModel model;
  for (int i = 0; i < nodes; ++i) {
    const Eigen::Index width = i + 1 < nodes ? 12 : 6;
    K.block(6 * i, 6 * i, width, width) += gram(width, 1e7);
    M.block(6 * i, 6 * i, 6, 6) += gram(6, 0.3) + 0.1 * Eigen::MatrixXd::Identity(6, 6);
    for (int component = 1; component <= 6; ++component) model.dofs.push_back({101 + i, component});
    model.positions[101 + i] = Eigen::Vector3d(0.1 * i, normal(random), 1.0 / 3.0);
  }
  for (const Eigen::Index mode : {n - 2, n - 1}) {
    K(mode, mode) = 1e6 * std::abs(normal(random));
    M(mode, mode) = 1.0;
    M(mode, 0) = M(0, mode) = 0.01 * normal(random);
    model.dofs.push_back({static_cast<int>(1001 + mode), 0});
  }
  model.K = K.sparseView();
  model.M = M.sparseView();
  if (damped) model.C = Eigen::MatrixXd(1e-5 * K).sparseView();
  return model;
}

inline bool same(const Eigen::SparseMatrix<double>& A, const Eigen::SparseMatrix<double>& B) {
  return A.rows() == B.rows() && A.cols() == B.cols() && Eigen::MatrixXd(A) == Eigen::MatrixXd(B);
}

/// Bit by bit, positions and names too.
inline bool same(const dynamics::SparseModel& a, const dynamics::SparseModel& b) {
  return same(a.K, b.K) && same(a.M, b.M) && same(a.C, b.C) && a.dofs == b.dofs && a.names == b.names &&
         a.positions == b.positions;
}

}  // namespace thinwall::io::test

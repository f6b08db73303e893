#pragma once
// Tables of modes of small matrices.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/dense_eigenvalues.hpp"
#include "dynamics/modal_table.hpp"

namespace thinwall::tests {

/// Matrices of two points, 1 and a, along x and y.
struct Matrices {
  Eigen::MatrixXd M, D, K;
};

/// Springs and dashpots that are neither proportional nor, with `servo`, symmetric; stiffer along x by `stiffer`.
inline Matrices two_points(double servo, double stiffer = 1.0) {
  Matrices s{Eigen::MatrixXd(4, 4), Eigen::MatrixXd(4, 4), Eigen::MatrixXd(4, 4)};
  s.M = Eigen::Vector4d(3.0, 4.0, 1.5, 2.0).asDiagonal();
  s.K << 9e5, 1e5, -3e5, 0.0, 1e5, 7e5, 0.0, -2e5, -3e5, 0.0, 5e5, 5e4, 0.0, -2e5, 5e4, 6e5;
  s.K(0, 0) *= stiffer;
  s.K(0, 1) += servo * 1e5;
  s.D = 2e-4 * s.K;
  s.D(0, 0) += 60.0;
  s.D(3, 3) += 40.0;
  return s;
}

/// Modes of M ẍ + D ẋ + K x = f by the eigenvectors of its state matrix, with velocities in units of `unit`.
inline dynamics::ModalTable table_of(const Matrices& s) {
  const auto translation = dynamics::DofKind::translation;
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
  dynamics::ModalTable table{
      {{"1", x, translation}, {"1", y, translation}, {"a", x, translation}, {"a", y, translation}}, {}};
  const Eigen::Index n = s.M.rows();
  const double unit = 500.0;  // rad/s, of the order of the frequencies: else the vectors lose digits
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n) = unit * Eigen::MatrixXd::Identity(n, n);
  A.bottomLeftCorner(n, n) = -s.M.inverse() * s.K / unit;
  A.bottomRightCorner(n, n) = -s.M.inverse() * s.D;
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(A);
  const Eigen::MatrixXcd Z = solver.eigenvectors(), W = Eigen::MatrixXcd(Z.inverse());
  for (Eigen::Index k = 0; k < 2 * n; ++k) {
    const std::complex<double> pole = solver.eigenvalues()(k);
    if (pole.imag() <= 0.0) continue;
    const Eigen::VectorXcd left = (W.row(k).tail(n) * s.M.inverse()).transpose() / unit;
    table.rows.push_back({"", std::abs(pole) / (2.0 * std::numbers::pi), -pole.real() / std::abs(pole),
                          Z.col(k).head(n), left, Eigen::VectorXd::Zero(n)});
  }
  std::ranges::sort(table.rows, {}, &dynamics::ModalTableRow::frequency_hz);
  return table;
}

}  // namespace thinwall::tests

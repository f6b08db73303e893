#pragma once
// Semi-discretization of order 0 written straight from the literature, as the other side of a ratio.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unsupported/Eigen/MatrixFunctions>

#include "core/dense_eigenvalues.hpp"

namespace thinwall::bench {

/// Two degrees of freedom, x and y, each of one mode; straight equal teeth; down-milling.
struct TwoDofMill {
  double omega = 0.0, zeta = 0.0, mass = 0.0;  ///< rad/s, 1, kg
  double K_t = 0.0, K_r = 0.0;                 ///< N/m²
  int teeth = 0;
  double immersion = 0.0;  ///< a/D
};

/// |μ| of Insperger & Stepan (2004): m steps a tooth period, the directional matrix at the middle of a step, the
/// delayed term as the mean of two samples, states and m delayed displacements in one dense vector, the period's map as
/// the product of m dense matrices, its eigenvalues dense.
inline double dense_semi_discretization(const TwoDofMill& mill, double spindle_speed_rpm, double depth_m, int m) {
  const double period = 60.0 / (mill.teeth * spindle_speed_rpm);
  const double entry = std::acos(2.0 * mill.immersion - 1.0);
  const Eigen::Index size = 4 + 2 * m;
  Eigen::MatrixXd product = Eigen::MatrixXd::Identity(size, size);
  for (int i = 0; i < m; ++i) {
    Eigen::Matrix2d h = Eigen::Matrix2d::Zero();
    for (int j = 0; j < mill.teeth; ++j) {
      const double turn = (i + 0.5) / m / mill.teeth + static_cast<double>(j) / mill.teeth;
      const double phi = 2.0 * std::numbers::pi * turn;
      if (phi <= entry || phi >= std::numbers::pi) continue;
      const double s = std::sin(phi), c = std::cos(phi);
      h(0, 0) += s * (mill.K_t * c + mill.K_r * s);
      h(0, 1) += c * (mill.K_t * c + mill.K_r * s);
      h(1, 0) += s * (-mill.K_t * s + mill.K_r * c);
      h(1, 1) += c * (-mill.K_t * s + mill.K_r * c);
    }
    const Eigen::Matrix2d cutting = depth_m / mill.mass * h;
    Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
    A.topRightCorner<2, 2>().setIdentity();
    A.bottomLeftCorner<2, 2>() = -mill.omega * mill.omega * Eigen::Matrix2d::Identity() - cutting;
    A.bottomRightCorner<2, 2>() = -2.0 * mill.zeta * mill.omega * Eigen::Matrix2d::Identity();
    Eigen::Matrix<double, 4, 2> B = Eigen::Matrix<double, 4, 2>::Zero();
    B.bottomRows<2>() = cutting;
    const Eigen::Matrix4d P = (A * (period / m)).exp();
    const Eigen::Matrix<double, 4, 2> R = A.inverse() * (P - Eigen::Matrix4d::Identity()) * B;
    Eigen::MatrixXd step = Eigen::MatrixXd::Zero(size, size);
    step.topLeftCorner(4, 4) = P;
    step.block(0, size - 4, 4, 2) = 0.5 * R;
    step.block(0, size - 2, 4, 2) = 0.5 * R;
    step.block(4, 0, 2, 2).setIdentity();
    step.block(6, 4, size - 6, size - 6).setIdentity();
    product = (step * product).eval();
  }
  return product.eigenvalues().cwiseAbs().maxCoeff();
}

}  // namespace thinwall::bench

#pragma once
// Models that the tests of this folder share.

#include <random>

#include "dynamics/spatial_model.hpp"

namespace thinwall::dynamics::testing {

/// A chain of n masses of 0.5…1.5 kg with springs of 1e5…2e6 N/m to its neighbours and to the ground, one point each;
/// C = 0.
inline SpatialModel spring_chain(int n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> mass(0.5, 1.5);
  std::uniform_real_distribution<double> stiffness(1e5, 2e6);
  SpatialModel model{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n), {}, {}};
  for (int i = 0; i < n; ++i) {
    model.M(i, i) = mass(random);
    model.K(i, i) += stiffness(random);
    model.dofs.push_back({"p" + std::to_string(i), Eigen::Vector3d::UnitX(), DofKind::translation});
    if (i == 0) continue;
    const double k = stiffness(random);
    model.K.block<2, 2>(i - 1, i - 1) += (Eigen::Matrix2d() << k, -k, -k, k).finished();
  }
  return model;
}

/// A A ᵀ for a random n × rank matrix A, scaled to a largest entry of `size`: positive semidefinite and not
/// proportional.
inline Eigen::MatrixXd semidefinite(int n, int rank, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(n, rank, [&] { return normal(random); });
  const Eigen::MatrixXd P = A * A.transpose();
  return P * (size / P.cwiseAbs().maxCoeff());
}

}  // namespace thinwall::dynamics::testing

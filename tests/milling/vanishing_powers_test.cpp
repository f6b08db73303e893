#include "milling/direct/vanishing_powers.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "core/dense_eigenvalues.hpp"

namespace thinwall::milling::vanishing_powers_test {
namespace {

using Eigen::Index;

Eigen::Matrix2d spiral(double radius) {
  return radius * Eigen::Rotation2Dd(0.7).toRotationMatrix();
}

TEST(VanishingPowers, AreSeenInsideOfTheCircleAndNeverOutside) {
  for (const double gap : {1e-1, 1e-3, 1e-5}) {
    EXPECT_TRUE(powers_vanish(spiral(1.0 - gap))) << gap;
    EXPECT_FALSE(powers_vanish(spiral(1.0 + gap))) << gap;
  }
  EXPECT_FALSE(powers_vanish(spiral(1.0)));
}

TEST(VanishingPowers, OfRandomMatricesAgreeWithTheirEigenvalues) {
  for (Index n = 3; n <= 63; n += 12) {
    const Eigen::MatrixXd random = Eigen::MatrixXd::Random(n, n);
    const Eigen::MatrixXd M = random / random.eigenvalues().cwiseAbs().maxCoeff();
    EXPECT_TRUE(powers_vanish(0.999 * M)) << n;
    EXPECT_FALSE(powers_vanish(1.001 * M)) << n;
  }
}

TEST(VanishingPowers, DoNotDependOnUnits) {
  const Eigen::MatrixXd random = Eigen::MatrixXd::Random(20, 20);
  const Eigen::MatrixXd M = random / random.eigenvalues().cwiseAbs().maxCoeff();
  Eigen::VectorXd units(20);
  for (Index i = 0; i < 20; ++i) units(i) = std::pow(10.0, static_cast<double>(i % 9));
  EXPECT_TRUE(powers_vanish(units.asDiagonal() * (0.999 * M) * units.cwiseInverse().asDiagonal()));
}

TEST(VanishingPowers, AreNotClaimedWhereRoundOffWouldDecide) {
  // Radius 0.9, but the powers first grow to some 1e4: the eigenvalues must tell.
  Eigen::MatrixXd M = 0.9 * Eigen::MatrixXd::Identity(8, 8);
  M.diagonal(1).setOnes();
  M(7, 0) = 1e-12;
  Eigen::MatrixXd outside = M;
  outside.diagonal().setConstant(1.01);
  EXPECT_FALSE(powers_vanish(outside));
  M(2, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(powers_vanish(M));
}

}  // namespace
}  // namespace thinwall::milling::vanishing_powers_test

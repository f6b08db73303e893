#include "fem/quadrature.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace thinwall::fem::quadrature_test {
namespace {

/// ∫ λ^γ dV / V = 6 Π γ_k! / (|γ| + 3)!.
double mean_of_monomial(const std::array<int, 4>& gamma) {
  double log = std::log(6.0);
  int degree = 0;
  for (const int g : gamma) {
    log += std::lgamma(g + 1.0);
    degree += g;
  }
  return std::exp(log - std::lgamma(degree + 4.0));
}

double mean_by_rule(const TetQuadrature& rule, const std::array<int, 4>& gamma) {
  double sum = 0.0;
  for (Eigen::Index q = 0; q < rule.weight.size(); ++q) {
    double value = rule.weight(q);
    for (std::size_t k = 0; k < 4; ++k) value *= std::pow(rule.lambda(static_cast<Eigen::Index>(k), q), gamma[k]);
    sum += value;
  }
  return sum;
}

/// All γ with |γ| = degree; a complete basis of the polynomials up to that degree, as Σλ = 1.
double worst_error(const TetQuadrature& rule, int degree) {
  double worst = 0.0;
  for (int a = 0; a <= degree; ++a) {
    for (int b = 0; a + b <= degree; ++b) {
      for (int c = 0; a + b + c <= degree; ++c) {
        const std::array<int, 4> gamma{a, b, c, degree - a - b - c};
        const double exact = mean_of_monomial(gamma);
        worst = std::max(worst, std::abs(mean_by_rule(rule, gamma) - exact) / exact);
      }
    }
  }
  return worst;
}

TEST(TetQuadrature, IsExactToItsDegreeAndNotBeyond) {
  for (int points = 1; points <= 10; ++points) {
    const TetQuadrature rule = tet_quadrature(points);
    ASSERT_EQ(rule.weight.size(), points * points * points);
    const double exact = worst_error(rule, 2 * points - 1);
    const double beyond = worst_error(rule, 2 * points);
    std::printf("%d points a direction: degree %d to %.1e, degree %d to %.1e\n", points, 2 * points - 1, exact,
                2 * points, beyond);
    EXPECT_LT(exact, 2e-12) << points;
    // λ₃^{2n} is missed by the Gauss rule of its own direction, less and less as n grows.
    EXPECT_GT(beyond, 1e-6) << points;
  }
}

TEST(TetQuadrature, WeightsArePositiveAndPointsInside) {
  for (int points = 1; points <= 20; ++points) {
    const TetQuadrature rule = tet_quadrature(points);
    EXPECT_GT(rule.weight.minCoeff(), 0.0) << points;
    EXPECT_GT(rule.lambda.minCoeff(), 0.0) << points;
    EXPECT_NEAR(rule.weight.sum(), 1.0, 1e-13) << points;
    EXPECT_LT((rule.lambda.colwise().sum().array() - 1.0).abs().maxCoeff(), 1e-15) << points;
  }
}

TEST(TetQuadrature, OnePointIsTheCentroid) {
  const TetQuadrature rule = tet_quadrature(1);
  EXPECT_LT((rule.lambda.col(0) - Eigen::Vector4d::Constant(0.25)).cwiseAbs().maxCoeff(), 1e-15);
}

}  // namespace
}  // namespace thinwall::fem::quadrature_test

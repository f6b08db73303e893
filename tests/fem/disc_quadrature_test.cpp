#include "fem/disc_quadrature.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace thinwall::fem::disc_quadrature_test {
namespace {

using Corners = Eigen::Matrix<double, 2, 3>;

double area(const Corners& c) {
  Eigen::Matrix2d edges;
  edges << c.col(1) - c.col(0), c.col(2) - c.col(0);
  return 0.5 * std::abs(edges.determinant());
}

/// Adds ∫ x^i y^j dA over the part of a triangle in a disc to the entries (i, j) of `moments`, i + j ≤ degree.
void add_moments(const Corners& corners, double radius, int points, int degree, Eigen::MatrixXd& moments) {
  const TriangleQuadrature rule = disc_quadrature(corners, radius, points);
  for (Eigen::Index q = 0; q < rule.weight.size(); ++q) {
    EXPECT_GT(rule.weight(q), 0.0);
    EXPECT_GT(rule.lambda.col(q).minCoeff(), -1e-12) << "inside the triangle";
    const Eigen::Vector2d x = corners * rule.lambda.col(q);
    EXPECT_LT(x.norm(), radius * (1.0 + 1e-12)) << "inside the disc";
    double x_to_i = area(corners) * rule.weight(q);
    for (int i = 0; i <= degree; ++i, x_to_i *= x.x()) {
      double term = x_to_i;
      for (int j = 0; i + j <= degree; ++j, term *= x.y()) moments(i, j) += term;
    }
  }
}

Eigen::MatrixXd moments(const std::vector<Corners>& triangles, double radius, int points, int degree) {
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(degree + 1, degree + 1);
  for (const Corners& triangle : triangles) add_moments(triangle, radius, points, degree, sums);
  return sums;
}

/// ∫ x^i y^j dA over the disc: 2 R^(i+j+2) / (i + j + 2) · Γ((i+1)/2) Γ((j+1)/2) / Γ((i+j)/2 + 1) for even i and j.
double moment_of_disc(double radius, int i, int j) {
  if (i % 2 != 0 || j % 2 != 0) return 0.0;
  return 2.0 * std::pow(radius, i + j + 2) / (i + j + 2) *
         std::exp(std::lgamma(0.5 * (i + 1)) + std::lgamma(0.5 * (j + 1)) - std::lgamma(0.5 * (i + j) + 1.0));
}

/// Triangles over the square of half width `half` about `middle`, whose inner grid points are moved at random.
std::vector<Corners> triangles_over(const Eigen::Vector2d& middle, double half, int cells, std::mt19937& random) {
  std::uniform_real_distribution<double> shift(-0.3, 0.3);
  const double h = 2.0 * half / cells;
  std::vector<std::vector<Eigen::Vector2d>> grid(static_cast<std::size_t>(cells) + 1);
  for (int i = 0; i <= cells; ++i) {
    for (int j = 0; j <= cells; ++j) {
      const bool inner = i > 0 && j > 0 && i < cells && j < cells;
      const Eigen::Vector2d moved = inner ? Eigen::Vector2d(shift(random), shift(random)) : Eigen::Vector2d(0.0, 0.0);
      grid[static_cast<std::size_t>(i)].emplace_back(middle + Eigen::Vector2d(-half, -half) +
                                                     h * (Eigen::Vector2d(i, j) + moved));
    }
  }
  std::vector<Corners> triangles;
  for (std::size_t i = 0; i < static_cast<std::size_t>(cells); ++i) {
    for (std::size_t j = 0; j < static_cast<std::size_t>(cells); ++j) {
      Corners one, other;
      one << grid[i][j], grid[i + 1][j], grid[i + 1][j + 1];
      other << grid[i][j], grid[i][j + 1], grid[i + 1][j + 1];  // the other sense of rotation
      triangles.push_back(one);
      triangles.push_back(other);
    }
  }
  return triangles;
}

TEST(DiscQuadrature, OverTrianglesThatCoverADiscSumsToItsMoments) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const double R = 3e-3;
  for (int round = 0; round < 60; ++round) {
    // From one square much larger than the disc to triangles much smaller; discs on a grid point, on an edge and
    // anywhere.
    const int cells = 1 + round % 12;
    const Eigen::Vector2d middle = round % 3 == 0   ? Eigen::Vector2d(0.0, 0.0)
                                   : round % 3 == 1 ? Eigen::Vector2d(0.0, 0.3 * R * unit(random))
                                                    : Eigen::Vector2d(0.4 * R * unit(random), 0.4 * R * unit(random));
    const auto triangles = triangles_over(middle, round % 2 == 0 ? 1.5 * R : 8.0 * R, cells, random);
    for (const int points : {2, 5, 8}) {
      const int degree = 2 * points - 2;
      const Eigen::MatrixXd sums = moments(triangles, R, points, degree);
      for (int i = 0; i <= degree; ++i)
        for (int j = 0; i + j <= degree; ++j)
          EXPECT_NEAR(sums(i, j), moment_of_disc(R, i, j), 1e-12 * std::pow(R, i + j + 2)) << i << " " << j;
    }
  }
}

TEST(DiscQuadrature, OfATriangleWhoseCornersOrEdgesTouchTheCircleIsItsClosedForm) {
  const double R = 1.0, root3 = std::sqrt(3.0);
  const auto share_area = [&](const Corners& c) { return moments({c}, R, 3, 0)(0, 0); };
  Corners inscribed, circumscribed, touching, far, half;
  inscribed << 1.0, -0.5, -0.5, 0.0, 0.5 * root3, -0.5 * root3;
  EXPECT_NEAR(share_area(inscribed), area(inscribed), 1e-14);
  circumscribed = 2.0 * inscribed;  // all three edges touch the circle from outside
  EXPECT_NEAR(share_area(circumscribed), std::numbers::pi, 1e-13);
  touching << 1.0, 2.0, 2.0, 0.0, 1.0, -1.0;  // one corner on the circle
  EXPECT_NEAR(share_area(touching), 0.0, 1e-14);
  far << 2.0, 3.0, 2.0, 0.0, 0.0, 1.0;
  EXPECT_EQ(disc_quadrature(far, R, 3).weight.size(), 0);
  half << -5.0, 5.0, 0.0, 0.0, 0.0, 9.0;  // the centre on an edge: half the disc
  EXPECT_NEAR(share_area(half), 0.5 * std::numbers::pi, 1e-13);
  EXPECT_NEAR(moments({half}, R, 3, 1)(0, 1), 2.0 / 3.0, 1e-13) << "4R/(3π) from the edge";
  for (const double off : {-1e-9, -1e-13, 1e-13, 1e-9}) {
    EXPECT_NEAR(share_area((1.0 + off) * inscribed), area(inscribed), 1e-8);
    EXPECT_NEAR(share_area((1.0 + off) * circumscribed), std::numbers::pi, 1e-8);
    EXPECT_NEAR(share_area((1.0 + off) * touching), 0.0, 1e-8);
  }
}

}  // namespace
}  // namespace thinwall::fem::disc_quadrature_test

#include "fem/quadrature.hpp"

#include <cassert>
#include <cmath>

#include "core/dense_eigenvalues.hpp"

namespace thinwall::fem {

namespace {

/// A quadrature rule on (0, 1).
struct LineRule {
  Eigen::VectorXd x;  // points in (0, 1)
  Eigen::VectorXd w;  // weights, sum 1
};

/// The Gauss rule for the weight (1 − x)^a on (0, 1), a = 0, 1, 2, from the eigenvalues of the Jacobi matrix (Golub &
/// Welsch 1969) of the Jacobi polynomials P^{(a, 0)} on (−1, 1).
LineRule gauss_jacobi(int points, int a) {
  Eigen::VectorXd diagonal(points);
  Eigen::VectorXd off(std::max(points - 1, 1));
  for (int k = 0; k < points; ++k) {
    const double s = 2.0 * k + a;
    diagonal(k) = k == 0 ? -a / (a + 2.0) : -a * a / (s * (s + 2.0));
    if (k > 0) off(k - 1) = std::sqrt(4.0 * k * k * (k + a) * (k + a) / (s * s * (s + 1.0) * (s - 1.0)));
  }
  if (points == 1) return {Eigen::VectorXd::Constant(1, 0.5 * (1.0 + diagonal(0))), Eigen::VectorXd::Ones(1)};
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen;
  eigen.computeFromTridiagonal(diagonal, off);
  return {0.5 * (eigen.eigenvalues().array() + 1.0), eigen.eigenvectors().row(0).cwiseAbs2().transpose()};
}

}  // namespace

TetQuadrature tet_quadrature(int points) {
  assert(points >= 1 && points <= 20);
  const LineRule u = gauss_jacobi(points, 2);
  const LineRule v = gauss_jacobi(points, 1);
  const LineRule w = gauss_jacobi(points, 0);
  TetQuadrature rule;
  rule.lambda.resize(4, points * points * points);
  rule.weight.resize(points * points * points);
  Eigen::Index q = 0;
  // The map (u, v, w) → (u, (1 − u) v, (1 − u)(1 − v) w) takes the cube to the tetrahedron. Its Jacobian (1 − u)² (1 −
  // v) is contained in the weight functions of the rules for u and v.
  for (int i = 0; i < points; ++i) {
    for (int j = 0; j < points; ++j) {
      for (int k = 0; k < points; ++k, ++q) {
        const double first = u.x(i);
        const double second = (1.0 - first) * v.x(j);
        const double third = (1.0 - first) * (1.0 - v.x(j)) * w.x(k);
        rule.lambda.col(q) << 1.0 - first - second - third, first, second, third;
        rule.weight(q) = u.w(i) * v.w(j) * w.w(k);
      }
    }
  }
  return rule;
}

TriangleQuadrature triangle_quadrature(int points) {
  assert(points >= 1 && points <= 20);
  const LineRule u = gauss_jacobi(points, 1);
  const LineRule v = gauss_jacobi(points, 0);
  TriangleQuadrature rule;
  rule.lambda.resize(3, points * points);
  rule.weight.resize(points * points);
  Eigen::Index q = 0;
  for (int i = 0; i < points; ++i) {
    for (int j = 0; j < points; ++j, ++q) {
      const double second = (1.0 - u.x(i)) * v.x(j);
      rule.lambda.col(q) << 1.0 - u.x(i) - second, u.x(i), second;
      rule.weight(q) = u.w(i) * v.w(j);
    }
  }
  return rule;
}

}  // namespace thinwall::fem

#include "fem/quadrature.hpp"

#include <cassert>

#include "core/gauss_rule.hpp"

namespace thinwall::fem {

TetQuadrature tet_quadrature(int points) {
  assert(points >= 1 && points <= 20);
  const core::GaussRule u = core::gauss_jacobi(points, 2);
  const core::GaussRule v = core::gauss_jacobi(points, 1);
  const core::GaussRule w = core::gauss_jacobi(points, 0);
  TetQuadrature rule;
  rule.lambda.resize(4, points * points * points);
  rule.weight.resize(points * points * points);
  Eigen::Index q = 0;
  // The map (u, v, w) → (u, (1 − u) v, (1 − u)(1 − v) w) takes the cube to the tetrahedron. Its Jacobian (1 − u)² (1 −
  // v) is contained in the weight functions of the rules for u and v.
  for (int i = 0; i < points; ++i) {
    for (int j = 0; j < points; ++j) {
      for (int k = 0; k < points; ++k, ++q) {
        const double first = u.node(i);
        const double second = (1.0 - first) * v.node(j);
        const double third = (1.0 - first) * (1.0 - v.node(j)) * w.node(k);
        rule.lambda.col(q) << 1.0 - first - second - third, first, second, third;
        rule.weight(q) = u.weight(i) * v.weight(j) * w.weight(k);
      }
    }
  }
  return rule;
}

TriangleQuadrature triangle_quadrature(int points) {
  assert(points >= 1 && points <= 20);
  const core::GaussRule u = core::gauss_jacobi(points, 1);
  const core::GaussRule v = core::gauss_jacobi(points, 0);
  TriangleQuadrature rule;
  rule.lambda.resize(3, points * points);
  rule.weight.resize(points * points);
  Eigen::Index q = 0;
  for (int i = 0; i < points; ++i) {
    for (int j = 0; j < points; ++j, ++q) {
      const double second = (1.0 - u.node(i)) * v.node(j);
      rule.lambda.col(q) << 1.0 - u.node(i) - second, u.node(i), second;
      rule.weight(q) = u.weight(i) * v.weight(j);
    }
  }
  return rule;
}

}  // namespace thinwall::fem

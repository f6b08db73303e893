#pragma once
// The volume of tetrahedra of order 1 and 2 by quadrature, curved ones too.

#include <Eigen/LU>

#include "mesh/solid/solid_mesh.hpp"

namespace thinwall::mesh {

/// det J = det ∂x/∂ξ of an element of order 2 at barycentric coordinates l.
inline double quadratic_determinant(const LagrangeNodes& nodes, Eigen::Index element, const Eigen::Vector4d& l) {
  static const auto alphas = lattice(2);
  Eigen::Matrix<double, 3, 4> slope = Eigen::Matrix<double, 3, 4>::Zero();
  for (std::size_t a = 0; a < 10; ++a) {
    const Eigen::Vector3d x = nodes.positions.row(nodes.elements(element, static_cast<Eigen::Index>(a))).transpose();
    for (std::size_t k = 0; k < 4; ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      if (alphas[a][k] == 2) slope.col(column) += (4.0 * l(column) - 1.0) * x;
      for (std::size_t j = 0; j < 4; ++j)
        if (j != k && alphas[a][k] == 1 && alphas[a][j] == 1)
          slope.col(column) += 4.0 * l(static_cast<Eigen::Index>(j)) * x;
    }
  }
  const Eigen::Matrix3d J = slope.rightCols<3>().colwise() - slope.col(0);
  return J.determinant();
}

/// ∫ det J dξ, m³; det J is a cubic, which the five points of degree 3 integrate exactly (Keast 1986).
inline double volume_of(const SolidMesh& solid) {
  if (solid.nodes.order == 1) return volume(solid.mesh);
  double sum = 0.0;
  for (Eigen::Index e = 0; e < solid.nodes.elements.rows(); ++e) {
    sum -= 0.8 / 6.0 * quadratic_determinant(solid.nodes, e, Eigen::Vector4d::Constant(0.25));
    for (Eigen::Index k = 0; k < 4; ++k) {
      Eigen::Vector4d l = Eigen::Vector4d::Constant(1.0 / 6.0);
      l(k) = 0.5;
      sum += 0.45 / 6.0 * quadratic_determinant(solid.nodes, e, l);
    }
  }
  return sum;
}

}  // namespace thinwall::mesh

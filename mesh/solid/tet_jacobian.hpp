#pragma once
// A lower bound of the Jacobian of tetrahedra of order 1 and 2 over the whole element, not only at points.

#include <Eigen/Core>

#include "mesh/lagrange_nodes.hpp"

namespace thinwall::mesh {

/// The least det J, J = ∂x/∂ξ, over its mean in an element, and its place.
struct LeastJacobian {
  double ratio = 1.0;                            ///< least det J / mean; without volume the mean over l³
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< place of the least, m; without volume the centre
  bool is_sound = true;                          ///< true if det J exceeds the bound everywhere
  bool has_volume = true;                        ///< true if the mean is positive, beyond round-off
};

/// A bound on det J in an element of order 1 or 2. With x(ξ) = Σ N_a x_a of order 2, det J is a cubic polynomial. Its
/// Bernstein coefficients bound it from below on the whole element (Johnen, Remacle & Geuzaine 2013), and so at every
/// quadrature point and node; if they do not suffice, the element is divided into eight, at most four times. An element
/// is sound if det J > bound · mean everywhere, and the mean is above 1e-10 l³ with l the longest straight edge (below
/// that, the corners lie in one plane to round-off). For order 1 the mean is all that is checked. Throws InputError for
/// another order. Cost: some 2 µs for an element of order 2.
[[nodiscard]] LeastJacobian least_jacobian(const LagrangeNodes& nodes, Eigen::Index element, double bound);

}  // namespace thinwall::mesh

#pragma once
// The Jacobian of tetrahedra of order 1 and 2, bounded everywhere, not only at points.

#include <Eigen/Core>

#include "mesh/lagrange_nodes.hpp"

namespace thinwall::mesh {

/// det J, J = ∂x/∂ξ, over its mean in the element, and where it is least.
struct LeastJacobian {
  double ratio = 1.0;                            ///< det J / mean there; without volume the mean over l³
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< m; without volume the centre
  bool is_sound = true;                          ///< above the bound everywhere
  bool has_volume = true;                        ///< the mean is positive
};

/// x(ξ) = Σ N_a x_a makes det J a cubic for order 2. Its Bernstein coefficients bound it from below on the whole
/// element (Johnen, Remacle & Geuzaine 2013), and with it at every quadrature point and node; where they do not
/// suffice the element is cut in eight, four times at most. Sound: det J > bound · mean everywhere, and the mean above
/// 1e-10 l³ with l the longest straight edge (below, the corners lie in one plane to round-off). Order 1: the mean
/// alone. Throws InputError for another order. Cost: some 2 µs an element of order 2.
[[nodiscard]] LeastJacobian least_jacobian(const LagrangeNodes& nodes, Eigen::Index element, double bound);

}  // namespace thinwall::mesh

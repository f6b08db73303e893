#pragma once
// Sparse M and K of a part of Lagrange tetrahedra, straight or curved.

#include <Eigen/Core>
#include <vector>

#include "fem/material.hpp"
#include "linalg/sparse.hpp"
#include "mesh/lagrange_nodes.hpp"

namespace thinwall::fem {

/// Consistent mass and stiffness on the free rows. K in N/m, M in kg.
struct Assembled {
  linalg::SparseMatrix K;          ///< free × free
  linalg::SparseMatrix M;          ///< free × free
  linalg::SparseMatrix node_mass;  ///< ∫ ρ N_a N_b dV, nodes × nodes, before any constraint, kg
  std::vector<int> free_rows;      ///< for each row of K its 3·node + axis, ascending; displacement of the node, in m
  int curved_elements = 0;         ///< integrated by quadrature
  double least_jacobian = 1.0;     ///< smallest det J over its mean in an element; 1 for straight ones
};

/// Element matrices summed into sparse matrices. A straight element, its nodes on the lattice between its vertices:
///
///     M_e = ρ V M̂,   S^{ij} = V Σ_kl g_ki g_lj D̂^{kl},   K_e[ai, bj] = λ S^{ij}_ab + μ S^{ji}_ab + μ δ_ij Σ_m
///     S^{mm}_ab
///
/// with g_k = ∇λ_{k+1} constant in each element: exact, without quadrature (docs/theory/elements.md); a curved one by
/// curved_element(). Column by column: each column of K is summed by one thread from the elements around its node, in
/// their order, so that the result is the same for any number of threads. `fixed`: rows 3·node + axis left out, in any
/// order, duplicates allowed. Throws NumericalError if an element has no positive volume, is turned inside out
/// somewhere or has a node whose position is not finite, or if K outgrows 32-bit indices; InputError if nothing is left
/// free or for what validate(materials) refuses. Cost 162 flops an entry of a straight element.
[[nodiscard]] Assembled assemble(const mesh::LagrangeNodes& nodes, const Materials& materials,
                                 const std::vector<int>& fixed = {});

/// The same of one material.
[[nodiscard]] Assembled assemble(const mesh::LagrangeNodes& nodes, const Material& material,
                                 const std::vector<int>& fixed = {});

}  // namespace thinwall::fem

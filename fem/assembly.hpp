#pragma once
// Assembly of the sparse matrices M and K of a part made of Lagrange tetrahedra, straight or curved.

#include <Eigen/Core>
#include <vector>

#include "fem/material.hpp"
#include "linalg/sparse.hpp"
#include "mesh/lagrange_nodes.hpp"

namespace thinwall::fem {

/// Consistent mass (kg) and stiffness (N/m) matrices on the free rows.
struct Assembled {
  linalg::SparseMatrix K;          ///< free × free
  linalg::SparseMatrix M;          ///< free × free
  linalg::SparseMatrix node_mass;  ///< ∫ ρ N_a N_b dV, nodes × nodes, before any constraint, kg
  std::vector<int> free_rows;      ///< for each row of K its 3·node + axis, ascending; displacement of the node, in m
  int curved_elements = 0;         ///< number of elements integrated by quadrature
  double least_jacobian = 1.0;     ///< smallest det J over its mean in an element; 1 for straight ones
};

/// The matrices of a part, summed from those of its elements. The matrices of a straight element, whose nodes lie on
/// the lattice between its vertices, are
///
///     M_e = ρ V M̂,   S^{ij} = V Σ_kl g_ki g_lj D̂^{kl},
///     K_e[ai, bj] = λ S^{ij}_ab + μ S^{ji}_ab + μ δ_ij Σ_m S^{mm}_ab
///
/// with M̂ and D̂ of reference_element() and g_k = ∇λ_{k+1}, which is constant in the element, so that they are exact
/// without quadrature (docs/theory/elements.md, Eq. 2). Those of a curved element are curved_element()'s. Each column
/// of K is summed by one thread from the elements around its node, in their order, so that the result is the same for
/// any number of threads. `fixed`: rows 3·node + axis that are left out, in any order, duplicates allowed. Throws
/// NumericalError if an element has no positive volume, is turned inside out somewhere or has a node whose position is
/// not finite, or if K outgrows 32-bit indices; InputError if nothing is left free or for what validate(materials)
/// refuses. Cost 162 flops an entry of a straight element.
/// left free or for what validate(materials) refuses. Cost 162 flops an entry of a straight element.
[[nodiscard]] Assembled assemble(const mesh::LagrangeNodes& nodes, const Materials& materials,
                                 const std::vector<int>& fixed = {});

/// The matrices of a part of one material.
[[nodiscard]] Assembled assemble(const mesh::LagrangeNodes& nodes, const Material& material,
                                 const std::vector<int>& fixed = {});

}  // namespace thinwall::fem

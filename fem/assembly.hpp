#pragma once
// Sparse M and K of a part of straight-sided Lagrange tetrahedra.

#include <Eigen/Core>

#include "fem/material.hpp"
#include "linalg/sparse.hpp"
#include "mesh/lagrange_nodes.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::fem {

/// Consistent mass and stiffness over all nodes, before any constraint. Row 3·node + i is the displacement of the node
/// along axis i, in m; K in N/m, M in kg.
struct Assembled {
  linalg::SparseMatrix K;
  linalg::SparseMatrix M;
};

/// Element matrices summed into sparse matrices:
///
///     M_e = ρ V M̂,   S^{ij} = V Σ_kl g_ki g_lj D̂^{kl},   K_e[ai, bj] = λ S^{ij}_ab + μ S^{ji}_ab + μ δ_ij Σ_m
///     S^{mm}_ab
///
/// with g_k = ∇λ_{k+1} constant in each element: exact, without quadrature (docs/theory/elements.md).
/// Throws NumericalError if an element has no positive volume. Cost O(tets · nodes²) flops · 18.
[[nodiscard]] Assembled assemble(const mesh::TetMesh& mesh, const mesh::LagrangeNodes& nodes, const Material& material);

}  // namespace thinwall::fem

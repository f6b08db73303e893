#pragma once
// The interface of a full model: the displacements that remain visible after its reduction.

#include "dynamics/dof.hpp"
#include "linalg/sparse.hpp"

namespace thinwall::reduction {

/// Interface DOFs u_b = Wᵀ u: column j of W (full × interface) holds the weights of the displacement called dofs[j]
/// over the full model's free rows; a single node is a unit column, a patch a weighted average. Wᵀ W must be regular.
struct Interface {
  linalg::SparseMatrix W;
  dynamics::DofTable dofs;
};

}  // namespace thinwall::reduction

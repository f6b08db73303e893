#pragma once
// Addition of attachments (clamps, masses, springs, rigid patches) to a model's matrices.

#include <vector>

#include "fem/attachments.hpp"
#include "fem/model.hpp"

namespace thinwall::fem {

/// Adds clamps to the model's matrices, replaces the rows of each rigid patch by six, adds masses and springs, and sets
/// the rigid motions that are left free (docs/theory/elements.md, Eq. A1-A5). For a point with [u θ] = Wᵀ q (W: rows ×
/// 6, from motion_of_node() for an averaging point, its own six rows for a rigid one) and the 6 × 6 matrices of what is
/// attached to it (matrix_at_point()):
///
///     K += W K_s Wᵀ,   M += W M_m Wᵀ
///
/// model: as assembled, constrained by `fixed`. Throws InputError for what validate() refuses; for a patch that cannot
/// be found, that lies on a support, on two pieces (springs) or on another rigid patch; for a patch on one line that is
/// to feel a rotation; and for an averaging patch of more than 1500 nodes, whose dense block in W Wᵀ would have 20
/// million entries. Cost: a copy of K and of M for each kind of attachment present.
void attach(Model& model, const std::vector<int>& fixed, const Attachments& attachments);

}  // namespace thinwall::fem

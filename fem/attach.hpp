#pragma once
// Attachments put into a model's matrices.

#include <vector>

#include "fem/attachments.hpp"
#include "fem/model.hpp"

namespace thinwall::fem {

/// Adds clamps, makes rigid patches six rows each, adds masses and springs, and says which rigid motions are left. With
/// W the rows × 6 of a point, [u θ] = Wᵀ q (motion_of_node() over the nodes of an averaging one, its own six rows of a
/// rigid one), and the 6 × 6 matrices that hang on it (matrix_at_point()):
///
///     K += W K_s Wᵀ,   M += W M_m Wᵀ
///
/// model: as assembled, constrained by `fixed`. Throws InputError for what validate() refuses, a patch that cannot be
/// found or does not see a turn that is wanted, that lies on a support, on two pieces (springs), on another rigid
/// patch, or has more than 1500 nodes (averaging: its block of W Wᵀ is dense, 20 million entries then). Cost: a copy of
/// K and of M for each kind that is present.
void attach(Model& model, const std::vector<int>& fixed, const Attachments& attachments);

}  // namespace thinwall::fem

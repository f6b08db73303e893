#pragma once
// Conversion of imported matrices to the full model with which a reduction begins.

#include <vector>

#include "dynamics/sparse_model.hpp"
#include "reduction/full_model.hpp"
#include "reduction/interface.hpp"

namespace thinwall::reduction {

/// The full model with K and M of an imported model and the rigid motions found from them (rigid_body_modes()). Its
/// damping is not used: see damping.hpp. Throws InputError as dynamics::require_plausible() does, and for a DOF without
/// mass, which it names; NumericalError if K + αM is not positive definite. Cost: that of rigid_body_modes().
[[nodiscard]] FullModel full_model(const dynamics::SparseModel& model);

/// The node of each row of an imported model, numbered from 0 in the order of the table. Cost O(n log n).
[[nodiscard]] std::vector<int> node_of_row(const dynamics::SparseModel& model);

/// The interface of all DOFs of the given nodes, in the order of the table, with their names. Throws InputError for a
/// node that has no DOF. Cost O(n).
[[nodiscard]] Interface interface_at(const dynamics::SparseModel& model, const std::vector<int>& nodes);

}  // namespace thinwall::reduction

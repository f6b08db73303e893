#pragma once
// Imported matrices as what every reduction begins with.

#include <vector>

#include "dynamics/sparse_model.hpp"
#include "reduction/full_model.hpp"
#include "reduction/interface.hpp"

namespace thinwall::reduction {

/// K and M of an imported model, its rigid motions found from them (rigid_body_modes()). Its damping is not taken: see
/// damping.hpp. Throws InputError as dynamics::require_plausible(), and naming a DOF without mass, which reductions
/// cannot take; NumericalError where K + αM is not positive definite. Cost: of rigid_body_modes().
[[nodiscard]] FullModel full_model(const dynamics::SparseModel& model);

/// For each row of an imported model its node, numbered from 0 in the order of the table. Cost O(n log n).
[[nodiscard]] std::vector<int> node_of_row(const dynamics::SparseModel& model);

/// All DOFs of the given nodes as the interface, in the order of the table, each with its name. Throws InputError for a
/// node that has no DOF. Cost O(n).
[[nodiscard]] Interface interface_at(const dynamics::SparseModel& model, const std::vector<int>& nodes);

}  // namespace thinwall::reduction

#pragma once
// Rows of a table of modes as an identification gives them, and back.

#include <string>
#include <vector>

#include "dynamics/modal_table.hpp"
#include "identification/modal_fit.hpp"

namespace thinwall::setup {

/// The rows of a table as an identification would give them: residue R Lᵀ, largest entry of the left vector 1. Throws
/// DataError, with the file's name, for a mode that moves nothing.
[[nodiscard]] std::vector<identification::FittedMode> modes_of(const dynamics::ModalTable& table,
                                                               const std::string& file);

/// Modes as a table over DOFs that are responses and references, in the order of the residues' rows. A residue of more
/// than rank one, as of modes that overlap, becomes several rows. Places of all points are 0: they are one.
[[nodiscard]] dynamics::ModalTable table_of(std::vector<identification::FittedMode> modes,
                                            const dynamics::DofTable& dofs);

}  // namespace thinwall::setup

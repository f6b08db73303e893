#pragma once
// A check of a model's modes by a Sturm count and by a second eigen-solver.

#include "fem/modes.hpp"
#include "linalg/eigenpair_check.hpp"

namespace thinwall::fem {

/// The check of modes that modes() or modes_near() found: linalg::check_eigenpairs() on the model's K, M and factor.
/// λ in rad²/s². Throws Interrupted. Cost as said there.
linalg::EigenpairCheck check_modes(const Model& model, const Factored& factored, const Modes& modes);

/// Throws NumericalError with the figures, in Hz, unless the check agrees.
void require_agreement(const linalg::EigenpairCheck& check);

/// Checks the modes and keeps the outcome in Modes::check. Throws as check_modes() and require_agreement().
void verify(const Model& model, const Factored& factored, Modes& modes);

}  // namespace thinwall::fem

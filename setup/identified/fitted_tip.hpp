#pragma once
// Poles of a measured tool tip.

#include "setup/tool.hpp"

namespace thinwall::setup {

/// The modal model that is fitted to `measured` of a tool (identification/fit_response.hpp): modes and a constant, for
/// a model that other stages take has no other terms; DOFs tool.x … in the part's axes. Entries that no file gives are
/// those of their transposes; directions between which nothing was measured are taken as apart from each other, and
/// each is fitted by itself. Lines are weighed by their stated noise or by coherence and averages, else by their
/// scatter. Notes tell the modes with their intervals, warnings what speaks against the fit; beside the model
/// stand identified_draws others, fits to lines with other noise (identification/drawn_fits.hpp). Throws InputError as
/// identification::fit_response(), or for files that were not read. Cost: some ten
/// seconds at most.
[[nodiscard]] FittedTip fitted_tip(const Tool& tool);

}  // namespace thinwall::setup

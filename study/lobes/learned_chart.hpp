#pragma once
// A chart that learns from the cuts that were made.

#include "milling/observed/uncertain_cut.hpp"
#include "setup/machining_setup.hpp"
#include "study/results.hpp"

namespace thinwall::study {

/// The likelihood of the set-up's cuts with [lobes.uncertainty] as what is known beforehand. Throws InputError for a
/// bad uncertainty, and for more than learning::most_parameters parameters.
[[nodiscard]] learning::CutModel cut_model(const setup::CutSetup& source, const milling::Cut& nominal,
                                           const milling::StabilityOptions& options);

/// The answer to [calibration]: the posterior, the share of cuts that are predicted rightly before and, with folds, by
/// what the others teach, the limits of the draws over the speeds of the chart, and the next cut for one speed. Throws
/// InputError as learning::calibrate(). Cost: that of the posterior, and some thousand rows.
[[nodiscard]] LearnedChart learned_chart(const setup::CutSetup& source, const milling::Cut& nominal,
                                         const milling::StabilityOptions& options);

}  // namespace thinwall::study

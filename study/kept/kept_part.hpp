#pragma once
// The part of an earlier run, its fits and the charts, from a checkpoint.

#include <functional>

#include "milling/chart/lobes.hpp"
#include "setup/variation.hpp"
#include "study/kept/checkpoint.hpp"
#include "study/results.hpp"

namespace thinwall::study {

/// The computed part and its fits as an earlier run left them, or by `compute`, whose result is kept. What the fits
/// changed is written into `work`. Not kept: the entries of the full model's K and M (their sizes are there), and the
/// damped model.
void part_of_checkpoint(Checkpoint& kept, const setup::Variation& variation, setup::VariedSetup& work, Results& results,
                        const std::function<void(setup::VariedSetup&, Results&)>& compute);

/// The fits of part and robot together as an earlier run left them, or by `compute`, which adds them to
/// `results.updating`; they are kept. What they changed is written into `work`.
void fits_of_checkpoint(Checkpoint& kept, const setup::Variation& variation, setup::VariedSetup& work, Results& results,
                        const std::function<void(setup::VariedSetup&, Results&)>& compute);

/// Rows of a chart of that name from the checkpoint and into it.
[[nodiscard]] milling::KeptRows kept_rows(Checkpoint& kept, const std::string& chart);

/// The errors of a chart's rows at these speeds, kept or computed now.
[[nodiscard]] std::vector<DepthError> errors_of_checkpoint(Checkpoint& kept, const std::string& chart,
                                                           const std::vector<double>& speeds_rpm,
                                                           const std::function<std::vector<DepthError>()>& compute);

}  // namespace thinwall::study

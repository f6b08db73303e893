#pragma once
// Stability charts of the part alone and of the supported part.

#include <vector>

#include "setup/machining_setup.hpp"
#include "study/kept/checkpoint.hpp"
#include "study/lobes/cut_structure.hpp"
#include "study/lobes/structure_errors.hpp"
#include "study/results.hpp"

namespace thinwall::study {

/// The speeds that a chart has before its line is refined.
[[nodiscard]] std::vector<double> even_speeds(const setup::LobesOptions& wanted);

/// The case's own speed, if it has one, and those of the points: a chart answers at them too.
[[nodiscard]] std::vector<double> asked_speeds(const setup::CutSetup& source,
                                               const std::vector<milling::OperatingPoint>& points);

/// Options of the search at a speed, from [lobes].
[[nodiscard]] milling::StabilityOptions stability_options(const setup::LobesOptions& wanted);

/// Those options with what other methods than the direct one need.
[[nodiscard]] milling::MethodOptions method_options(const setup::LobesOptions& wanted);

/// The chart of a structure as the cut feels it, what `errors` of the structure make of its depths, and what it says of
/// operating points. Rows that are kept are taken, others kept as they are found. From samples there are neither
/// comparisons, a map, a robust chart nor sensitivities.
[[nodiscard]] StructureLobes compute_lobes(const setup::CutSetup& source, ChartOf of, CutStructure structure,
                                           const StructureErrors& errors,
                                           const std::vector<milling::OperatingPoint>& points, Checkpoint& kept);

/// Throws InputError, before anything is computed, if operating points are asked of a case without a chart or lie
/// deeper than it goes.
void require_chart_of(const setup::CutSetup& source, const std::vector<milling::OperatingPoint>& points);

}  // namespace thinwall::study

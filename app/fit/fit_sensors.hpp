#pragma once
// Masses that sat on the structure while it was measured, taken off the FRFs of `thinwall fit`.

#include <string>
#include <vector>

#include "app/fit/fit_input.hpp"

namespace thinwall::app {

/// Takes the masses of words such as "1=30 g" off the measured matrix (coupling::remove_point_mass()), one after the
/// other, and notes what each changes. Returns doubts: masses whose removal makes errors of some line grow more than
/// ten times (its condition), and directions that were not measured. Throws UsageError for a word that cannot be read,
/// and for a point that was not both excited and measured. Cost lines · DOFs² a mass.
[[nodiscard]] std::vector<std::string> free_of_sensors(FitMatrix& matrix, const std::vector<std::string>& words);

}  // namespace thinwall::app

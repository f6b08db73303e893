#pragma once
// Coefficients and their spread, put in by cutting.material.

#include "case/values.hpp"

namespace thinwall::cases {

/// Puts the coefficients of cutting.material (setup/materials/cut_materials.hpp) in the place of cutting.Kt and
/// cutting.Kr where these are not given, and with K_t their spread in that of lobes.uncertainty.coefficients, with the
/// rest of [lobes.uncertainty] where there is none, the method of the chart has one and the tool has poles. Leaves
/// values without a known material as they are.
void fill_in_material(CaseValues& values);

}  // namespace thinwall::cases

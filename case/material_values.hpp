#pragma once
// Coefficients and their spread, put in by cutting.material.

#include "case/values.hpp"

namespace thinwall::cases {

/// Puts the coefficients of cutting.material (setup/materials/) in the place of cutting.Kt and cutting.Kr where these
/// are not given, and with K_t their spread in that of lobes.uncertainty.coefficients, with the rest of
/// [lobes.uncertainty] where there is none, the method of the chart has one and the tool has poles. The power law also
/// gets its exponent and, with K_t, the mean chip of a slot at the thinnest printed feed; its K_r is a share of the
/// K_t of the case. Leaves values without a known material as they are.
void fill_in_material(CaseValues& values);

}  // namespace thinwall::cases

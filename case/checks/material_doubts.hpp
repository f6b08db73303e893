#pragma once
// Doubts about coefficients that cutting.material put in.

#include <string>
#include <vector>

#include "case/machining_case.hpp"

namespace thinwall::cases {

/// Adds a sentence on coefficients that are those of no tool of the case: their values, the number of sources, their
/// spread with the use that the robust chart makes of it, and what the sources do not print. Adds none where the case
/// has coefficients of its own, or no known material.
void ask_about_cut_material(const Case& source, std::vector<std::string>& doubts);

}  // namespace thinwall::cases

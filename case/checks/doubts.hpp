#pragma once
// Doubts about values that a case may have, and probably did not mean.

#include <string>
#include <vector>

#include "case/machining_case.hpp"

namespace thinwall::cases {

/// Doubts about values that are allowed, a sentence each, with the value that was perhaps meant: a part of metres whose
/// lengths were written without a unit, or whose wall is its largest extent; materials of very different stiffness;
/// coefficients of cutting.material, which are the middle of several tools; chips thinner than cutting.thinnest_chip;
/// joints of a URDF beside the chain, whose place nobody has stated.
[[nodiscard]] std::vector<std::string> doubts_about(const Case& source);

}  // namespace thinwall::cases

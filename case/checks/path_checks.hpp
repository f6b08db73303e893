#pragma once
// Checks of the path: what it needs of the case, and where its positions lie.

#include "case/checks/findings.hpp"
#include "case/machining_case.hpp"

namespace thinwall::cases {

/// Reports, of a case with a path, what it lacks for one (a modelled part, a cut, a range of speeds, a tool without
/// measured FRFs), keys that exclude each other, a path without length, and the first position at which the cut or a
/// contact that follows it lies off the part or on a support.
void check_path(const Case& source, Findings& findings);

}  // namespace thinwall::cases

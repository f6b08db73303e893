#pragma once
// Checks of the points and DOFs at which a case asks for something.

#include <string>

#include "case/checks/findings.hpp"
#include "case/machining_case.hpp"

namespace thinwall::cases {

/// Reports unless `name` is a point of the part that its reduction keeps; an empty name was reported before.
void require_kept(const Case& source, const std::string& key, const std::string& name, Findings& findings);

/// Reports unless the DOF's name ("P.x") names a direction; an empty name was reported before.
void require_direction(const std::string& key, const std::string& dof, Findings& findings);

}  // namespace thinwall::cases

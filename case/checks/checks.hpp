#pragma once
// Checks that one key alone cannot make: references, exclusions, geometry, sizes.

#include "case/machining_case.hpp"
#include "case/problem.hpp"

namespace thinwall::cases {

/// Every problem that shows between keys: names that nothing bears, keys that exclude each other or are missing
/// together, points outside the part, contacts on a clamped face or across the robot's direction, fits that can change
/// nothing, charts of parts without a model, meshes beyond memory, files that are not there.
[[nodiscard]] std::vector<Problem> check_case(const Case& source);

}  // namespace thinwall::cases

#pragma once
// What one key alone cannot tell: references, exclusions, geometry, sizes.

#include "app/case.hpp"
#include "app/problem.hpp"

namespace thinwall::app {

/// Every problem that shows between keys: names that nothing bears, keys that exclude each other or are missing
/// together, points outside the part, contacts on a clamped face, meshes beyond memory, files that are not there.
[[nodiscard]] std::vector<Problem> check_case(const Case& source);

/// Sizes to expect of a mesh of the part, before it is made (within a factor of about two).
struct SizeEstimate {
  double elements = 0.0;
  double nodes = 0.0;
  double dofs = 0.0;
  double seconds = 0.0;
};
[[nodiscard]] SizeEstimate estimate_size(const Part& part);

}  // namespace thinwall::app

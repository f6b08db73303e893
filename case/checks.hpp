#pragma once
// Checks that one key alone cannot make: references, exclusions, geometry, sizes.

#include "case/machining_case.hpp"
#include "case/problem.hpp"

namespace thinwall::cases {

/// Every problem that shows between keys: names that nothing bears, keys that exclude each other or are missing
/// together, points outside the part, contacts on a clamped face or across the robot's direction, fits that can change
/// nothing, charts of parts without a model, meshes beyond memory, files that are not there.
[[nodiscard]] std::vector<Problem> check_case(const Case& source);

/// Sizes to expect of the mesh of the case's part, before it is made (within a factor of about two): elements are the
/// integral of 6√2 / size³ over the box, the size graded around the points as the mesher will be asked for it; of
/// graded meshes their exact number on the coarsest level, with the order that it usually takes.
struct SizeEstimate {
  int order = 2;
  double elements = 0.0;
  double nodes = 0.0;
  double dofs = 0.0;
  double seconds = 0.0;
};
/// The sizes of the case's part, as SizeEstimate describes them.
[[nodiscard]] SizeEstimate estimate_size(const Case& source);

}  // namespace thinwall::cases

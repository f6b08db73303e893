#pragma once
// The size of a part's mesh before it is made, and the checks that it can be solved.

#include "case/checks/findings.hpp"
#include "case/machining_case.hpp"
#include "setup/part_size.hpp"

namespace thinwall::cases {

/// The size to expect of the mesh of the case's part, before it is made (within a factor of about two): elements are
/// the integral of 6√2 / size³ over the box, the size graded around the points as the mesher will be asked for it; of
/// graded meshes their exact number on the coarsest level, with the order that it usually takes. A part by matrices has
/// no elements.
[[nodiscard]] setup::PartSize estimate_size(const Case& source);

/// Reports keys of [part.mesh] that do not belong together, and meshes beyond what can be made or solved, with the size
/// or order that would do. The geometry of the part must be known.
void check_mesh_size(const Case& source, Findings& findings);

}  // namespace thinwall::cases

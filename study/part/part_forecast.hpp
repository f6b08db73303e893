#pragma once
// Findings of a run about its part, and the time that it takes, before anything is solved.

#include <memory>
#include <optional>

#include "fem/closed_part.hpp"
#include "setup/part_size.hpp"
#include "study/part/part_input.hpp"

namespace thinwall::study {

/// The size of the first mesh of a part whose surface or mesh a file holds (coarsest_mesh()), on which its supports and
/// clamps are looked up, and the time of the part, mostly within a factor of two and a half; none for other parts. A
/// solution of n degrees of freedom in e elements of m nodes takes
///
///     3e-7 e m² + 0.8 (n / 4e4)^(1.3 + 0.6 s)   seconds,      s the share of vertices within the part
///
/// which was measured on 21 parts and five meshes. The number of solutions is the usual one of the tolerance: two
/// orders and 0.4 of a third from 0.05 on, 0.3 of it and 0.1 of a fourth from 0.02 on, three orders and 0.6 of the
/// fourth from 0.01 on, all below, and a second level of 3.5 times as many degrees of freedom of a part that is held by
/// faces, of which 0.2 from 0.01 on; what comes after the first two within the part's time budget. Thin walls that
/// swing beside a face that is held as a whole, in waves as short as the elements, take all orders and 0.2 of the
/// second level below 0.05; a `first` mesh with rows at its edges takes two orders and 0.2 of a third from 0.01 on. A
/// mesh of a file is solved once more, of one order more, for its error. A reduction to a tolerance at points takes as
/// long again. The memory is that of the highest order that the first mesh may come to (fem::solution_bytes()), of the
/// solution before it, and 150 MB with 480 bytes a row for the program and its vectors; it is not known of more than
/// fifty thousand elements. Throws what coarsest_mesh() throws, and InputError for a support or clamp that holds no
/// face. `first`: what first_mesh() has made of the same input, or empty: it is made.
[[nodiscard]] std::optional<setup::PartSize> forecast(const PartInput& source,
                                                      const std::shared_ptr<const fem::FirstMesh>& first = {});

/// Throws InputError unless the points of the reduction determine the six rigid motions of a part that nothing holds:
/// the rank of the motions [d, (p − c) × d / s] of the points' directions d at their places p, with c and s centre and
/// size of the part.
void require_points_hold(const setup::PartSetup& source);

}  // namespace thinwall::study

#pragma once
// The rigid-body motions that the supports leave to a part, in words.

#include <string>
#include <vector>

#include "mesh/lagrange_nodes.hpp"

namespace thinwall::fem {

/// One line for each independent rigid-body motion that vanishes on all `fixed` rows (3·node + axis): none for a held
/// part, six for a free one, translations first. "translation along x", "rotation about y"; with the point (m) through
/// which the axis goes if no translation across it is free, "rotation about y through (0.1, 0, 0.02)"; a direction that
/// is no axis by its components; a turn with an advance is a "screw". Elements that share no vertex, directly or
/// through others, are separate pieces: each has its own motions, which say where it lies. The motions are the kernel
/// of the six rigid motions at the fixed rows, about each piece's centre, rotations scaled by its size. Cost O(nodes ·
/// pieces).
[[nodiscard]] std::vector<std::string> free_motions(const mesh::LagrangeNodes& nodes, const std::vector<int>& fixed);

/// The motions in one line for a message, with commas between them.
[[nodiscard]] std::string listed(const std::vector<std::string>& motions);

}  // namespace thinwall::fem

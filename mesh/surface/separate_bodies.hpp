#pragma once
// The closed bodies that a soup of triangles holds, told apart where they touch. Internal to mesh/.

#include <vector>

#include "mesh/triangle_soup.hpp"

namespace thinwall::mesh {

/// The bodies of a soup whose facets look outwards, each as a soup of its own: sets of triangles that are connected by
/// edges. Where more than two triangles meet at an edge, as where bodies touch, the triangles are sorted by their angle
/// about it, and two of them belong together if the wedge between them lies behind both; where wedges overlap, other
/// edges must connect the sets. Empty if the soup is open somewhere, or if a set is not closed, encloses no positive
/// volume or meets itself at an edge. Cost O(n log n).
[[nodiscard]] std::vector<TriangleSoup> separate_bodies(const TriangleSoup& soup);

}  // namespace thinwall::mesh

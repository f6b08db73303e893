#pragma once
// The union of closed bodies that touch or overlap. Internal to mesh/.

#include <optional>
#include <string>
#include <vector>

#include "mesh/confined.hpp"
#include "mesh/triangle_soup.hpp"

namespace thinwall::mesh {

/// The surface of a union, if there is one.
struct SolidUnion {
  std::optional<TriangleSoup> surface;
  std::string failure;  ///< why the computation ended without an answer; empty if it is known whether there is a union
};

/// The surface of the union of bodies, each a closed surface whose facets look outwards, by CGAL's corefinement with
/// exact constructions (Polygon Mesh Processing); only the coordinates of the result are rounded. Bodies whose surfaces
/// meet are united in pairs, and these again, until one is left. No surface if some of them meet no other one, or if
/// two meet in edges or points only, so that the union is no manifold; and none, with the failure, if it cannot be had
/// within the limits. Cost O(bodies² + n log n log bodies), in a process of its own.
[[nodiscard]] SolidUnion united(const std::vector<TriangleSoup>& bodies, const ProcessLimits& limits);

}  // namespace thinwall::mesh

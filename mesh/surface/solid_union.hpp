#pragma once
// The union of closed bodies that touch or overlap. Internal to mesh/.

#include <optional>
#include <vector>

#include "mesh/confined.hpp"
#include "mesh/triangle_soup.hpp"

namespace thinwall::mesh {

/// The surface of the union of bodies, each a closed surface whose facets look outwards, by CGAL's corefinement with
/// exact constructions (Polygon Mesh Processing); only the coordinates of the result are rounded. Bodies are added to
/// the first one after each other, each as soon as its surface meets that of those before. Empty if some of them meet
/// no other one, if two meet in edges or points only, so that the union is no manifold, or if it cannot be had within
/// the limits. Cost O(bodies² · n log n) at worst, in a process of its own.
[[nodiscard]] std::optional<TriangleSoup> united(const std::vector<TriangleSoup>& bodies, const ProcessLimits& limits);

}  // namespace thinwall::mesh

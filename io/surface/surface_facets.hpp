#pragma once
// Triangles of facets with any number of corners, which OFF, OBJ and PLY files contain.

#include <cstddef>
#include <functional>
#include <vector>

#include "mesh/triangle_soup.hpp"

namespace thinwall::io {

/// Largest number of corners of a facet.
inline constexpr int most_corners = 1000;

/// A list of facets.
struct FacetList {
  std::vector<int> corners;       ///< points, from 0
  std::vector<std::size_t> ends;  ///< for each facet the end of its corners
  std::vector<int> places;        ///< for each facet its line or row, for messages
};

/// The triangles of all facets in their order. Three corners are one triangle; more are a fan of triangles from the
/// corner for which the smallest triangle, seen along the facet's (Newell's) normal, is largest. Beyond 64 corners the
/// best of 33 to 64 evenly spaced ones is taken, and if none of these is valid the first valid one. A facet that no fan
/// fills is divided by clipped_ears(). Calls `fail(place, what)`, which must throw, for a facet with a missing point or
/// one that crosses itself. Cost O(corners) for a facet, and O(corners²) if none of the 64 is valid.
[[nodiscard]] mesh::TriangleSoup triangles_of(std::vector<Eigen::Vector3d> points, const FacetList& facets,
                                              const std::function<void(int, const std::string&)>& fail);

}  // namespace thinwall::io

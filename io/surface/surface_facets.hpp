#pragma once
// Facets of any number of corners, as OFF, OBJ and PLY hold them, to triangles.

#include <cstddef>
#include <functional>
#include <vector>

#include "mesh/triangle_soup.hpp"

namespace thinwall::io {

/// A facet has at most so many corners.
inline constexpr int most_corners = 1000;

/// Facets one after the other.
struct FacetList {
  std::vector<int> corners;       ///< points, from 0
  std::vector<std::size_t> ends;  ///< for each facet, where its corners end
  std::vector<int> places;        ///< for each facet the line or row that messages name
};

/// The triangles of all facets in their order: three corners are one triangle, more a fan of triangles from the corner
/// for which the smallest of them, seen along the facet's (Newell's) normal, is largest; beyond 64 corners the best of
/// 33 to 64 evenly spaced ones, and where none of these will do the first that does. Calls `fail(place, what)`, which
/// must throw, for a facet that names a missing point or that no fan from a corner fills. Cost O(corners) a facet, and
/// O(corners²) where none of the 64 will do.
[[nodiscard]] mesh::TriangleSoup triangles_of(std::vector<Eigen::Vector3d> points, const FacetList& facets,
                                              const std::function<void(int, const std::string&)>& fail);

}  // namespace thinwall::io

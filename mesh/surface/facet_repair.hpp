#pragma once
// Facets of a soup that are no surface: collapsed, double, without area.

#include <vector>

#include "mesh/surface/surface_finding.hpp"
#include "mesh/triangle_soup.hpp"

namespace thinwall::mesh {

/// Drops triangles that name a point twice: what merging points leaves of a sliver. Cost O(n).
[[nodiscard]] SurfaceFinding drop_collapsed(TriangleSoup& soup);

/// Of triangles with the same three points the first stays.
struct DroppedDuplicates {
  SurfaceFinding dropped;
  /// Triangles that stayed and whose double ran the other way round: both sides of a wall without thickness, unless
  /// one of them was merely turned. Numbers in the soup as it is then.
  std::vector<int> opposite;
};
/// Cost O(n log n).
[[nodiscard]] DroppedDuplicates drop_duplicates(TriangleSoup& soup);

/// Removes triangles whose three different points lie on a line (mesh::has_area): the neighbour beyond the longest edge
/// is split at the third point, which lies on that edge, so that the surface stays where it is and as closed as it was.
/// What remains, because points almost coincide or more than two triangles meet there, is `left`. Cost O(n log n) a
/// pass, one pass for each flat triangle that lies against another, at most 32.
struct SplitFlat {
  SurfaceFinding removed;
  SurfaceFinding left;
};
/// Removes them from the soup.
[[nodiscard]] SplitFlat split_flat(TriangleSoup& soup);

}  // namespace thinwall::mesh

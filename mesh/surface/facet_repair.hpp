#pragma once
// Removal of facets that belong to no surface: collapsed facets, repeated ones, those without area.

#include <vector>

#include "mesh/surface/surface_finding.hpp"
#include "mesh/triangle_soup.hpp"

namespace thinwall::mesh {

/// Drops triangles that use a point twice, which slivers do after their points were merged. Cost O(n).
[[nodiscard]] SurfaceFinding drop_collapsed(TriangleSoup& soup);

/// The result of drop_duplicates().
struct DroppedDuplicates {
  SurfaceFinding dropped;
  /// Triangles that were kept and whose duplicate ran the other way round: both sides of a wall without thickness,
  /// unless one of them was merely turned. Numbers are those in the soup afterwards.
  std::vector<int> opposite;
};
/// Drops all but the first of triangles with the same three points. Cost O(n log n).
[[nodiscard]] DroppedDuplicates drop_duplicates(TriangleSoup& soup);

/// The result of split_flat(): the triangles removed, and those left because points almost coincide or more than two
/// triangles meet there.
struct SplitFlat {
  SurfaceFinding removed;
  SurfaceFinding left;
};
/// Removes triangles whose three different points lie on a line (mesh::has_area()). The neighbour beyond the longest
/// edge is split at the third point, which lies on that edge, so that the surface keeps its place and stays as closed
/// as before. Cost O(n log n) for each pass, with one pass for each flat triangle that lies against another, at most
/// 32.
[[nodiscard]] SplitFlat split_flat(TriangleSoup& soup);

}  // namespace thinwall::mesh

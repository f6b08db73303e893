#pragma once
// Sharp edges of a surface, the smooth patches that they bound, and the lines that they form.

#include <array>
#include <vector>

#include "mesh/faceted_surface.hpp"

namespace thinwall::mesh {

/// A sequence of sharp edges between the same two patches, from corner to corner, or closed (the first vertex is the
/// last).
struct FeatureLine {
  std::vector<int> vertices;
  std::array<int, 2> patches{};  ///< on its two sides; equal if the line ends within a smooth patch
};

/// The smooth patches of a surface and the sharp lines between them.
struct SurfaceFeatures {
  std::vector<int> patch_of_triangle;
  int patches = 0;
  std::vector<FeatureLine> lines;
  std::vector<bool> is_corner;  ///< true for each vertex at which lines end or turn sharply
};

/// The features of a surface. An edge is sharp if the normals of its two triangles differ by more than
/// `sharp_angle_rad`, or if it is the ridge of a patch that would consist of two to four planes, which is no
/// tessellated curve; patches are the parts that sharp edges separate; a corner is a vertex at which a number other
/// than two of sharp edges meet, or two at more than this angle. The surface must be closed (mesh::require_closed()).
/// Cost O(n log n).
[[nodiscard]] SurfaceFeatures surface_features(const TriangleSurface& surface, double sharp_angle_rad);

}  // namespace thinwall::mesh

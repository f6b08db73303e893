#pragma once
// The surface of layers of constant cross-section, one on the other.

#include <Eigen/Core>
#include <vector>

#include "mesh/faceted_surface.hpp"

namespace thinwall::mesh {

/// A layer: what lies inside an odd number of the closed outlines (x, y), m, between two heights z, m.
struct Layer {
  double from_m = 0.0, to_m = 0.0;
  std::vector<std::vector<Eigen::Vector2d>> outlines;
};

/// The closed surface of each layer: its sides along the outlines and its two ends, by a constrained Delaunay
/// triangulation (CGAL). Vertices of different layers are not shared. Outlines may touch or cross. Cost O(corners log
/// corners).
[[nodiscard]] TriangleSurface stacked_prisms(const std::vector<Layer>& layers);

}  // namespace thinwall::mesh

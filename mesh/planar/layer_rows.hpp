#pragma once
// Rows of points along the borders of a plane region, at the distances of the graded layers.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "mesh/planar/border_graph.hpp"
#include "mesh/planar/prism_mesh.hpp"

namespace thinwall::mesh {

/// Points, and segments between them that a triangulation has to keep. Segments meet in their end points only.
struct Sketch {
  std::vector<Eigen::Vector2d> points;
  std::vector<std::array<int, 2>> segments;
  std::size_t borders = 0;  ///< the first so many segments are pieces of borders, the rest may be left out
};

/// The borders in pieces of the wanted size, with feet where the layers of two borders meet at a corner, and the rows:
/// point j of a row lies at distance j of the layers from its border; at a corner of angle θ rows a and b meet in the
/// mitre p + (b e₁ + a e₂) / sin θ, with a foot (b + a cos θ) / sin θ along the first border; at a re-entrant corner
/// the rows run on past it. Rows that would come near another border, or cross, are left out there. Throws InputError
/// as set_layer_widths() does. Cost O(points²).
[[nodiscard]] Sketch layer_rows(const Prism& prism, const BorderGraph& graph, const PrismMeshOptions& options);

/// Distance from p to the nearest point and to the nearest segment of the sketch, m.
[[nodiscard]] double point_distance(const Sketch& sketch, const Eigen::Vector2d& p);
/// See point_distance().
[[nodiscard]] double segment_distance(const Sketch& sketch, const Eigen::Vector2d& p);

}  // namespace thinwall::mesh

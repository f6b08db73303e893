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
  std::size_t borders = 0;  ///< number of segments that are pieces of borders; they come first, the rest is optional
};

/// The points and segments from which a plane region is triangulated with graded layers along its borders: the borders
/// in pieces of the wanted size, and rows of points beside them. Point j of a row lies at distance j of the layers
/// (layer_distances()) from its border. At a corner p of angle θ, with unit vectors e₁ and e₂ along its borders, rows a
/// and b meet in the mitre p + (b e₁ + a e₂) / sin θ, whose foot (corner_foot()) becomes a point of the border. At a
/// re-entrant corner the rows go on past the corner. Rows are left out where they would come near another border or
/// cross each other. Throws InputError as set_layer_widths() does. Cost O(points²).
[[nodiscard]] Sketch layer_rows(const Prism& prism, const BorderGraph& graph, const PrismMeshOptions& options);

/// Distance from p to the nearest point of the sketch, m.
[[nodiscard]] double point_distance(const Sketch& sketch, const Eigen::Vector2d& p);
/// Distance from p to the nearest segment of the sketch, m.
[[nodiscard]] double segment_distance(const Sketch& sketch, const Eigen::Vector2d& p);

}  // namespace thinwall::mesh

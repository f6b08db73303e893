#pragma once
// Triangles in the plane that conform to a prism's borders, and the two ways to make them.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "mesh/planar/border_graph.hpp"
#include "mesh/planar/prism_mesh.hpp"

namespace thinwall::mesh {

/// Counter-clockwise triangles, each with the heights of the material above it.
struct PlanarMesh {
  std::vector<Eigen::Vector2d> vertices;
  std::vector<std::array<int, 3>> triangles;
  std::vector<Extent> extents;
};

/// True if every border runs along x or y.
[[nodiscard]] bool rectilinear(const BorderGraph& graph);

/// Grid lines through all borders, graded layers beside them on either side where there is material, lines around the
/// spots, and even cells between; two triangles a cell. No corner of the part is cut off by a diagonal, so that no
/// element has all its vertices on two faces that meet there. For a rectilinear graph.
[[nodiscard]] PlanarMesh tensor_grid(const Prism& prism, const BorderGraph& graph, const PrismMeshOptions& options);

/// Constrained Delaunay triangulation (CGAL) of the borders, cut into pieces of the wanted size; of rows of points that
/// follow the borders at the distances of their layers, mitred at the corners; of rings around the spots; and of a
/// lattice of points between. Nothing is refined afterwards, so a narrow strip gets long triangles.
[[nodiscard]] PlanarMesh planar_delaunay(const Prism& prism, const BorderGraph& graph, const PrismMeshOptions& options);

}  // namespace thinwall::mesh

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

/// The mesh of a rectilinear graph: grid lines through all borders, graded layers beside them on either side that has
/// material, lines around the spots, and equal cells between; each cell is divided into two triangles. No corner of the
/// part is cut off by a diagonal, because an element there would have all its vertices on two faces that meet.
[[nodiscard]] PlanarMesh tensor_grid(const Prism& prism, const BorderGraph& graph, const PrismMeshOptions& options);

/// The mesh of any graph: a constrained Delaunay triangulation (CGAL) of the borders and rows of layer_rows(), of rings
/// of points around the spots, and of a lattice of points between. The triangulation is not refined afterwards, so that
/// a narrow strip gets long triangles.
[[nodiscard]] PlanarMesh planar_delaunay(const Prism& prism, const BorderGraph& graph, const PrismMeshOptions& options);

}  // namespace thinwall::mesh

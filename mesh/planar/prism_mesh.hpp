#pragma once
// Graded meshes of flat tetrahedra for prismatic parts, made for high element order: few elements, one through the
// wall, with thin ones along the edges, at which the solution is singular. With a rising order, convergence is fast if
// the elements are graded geometrically towards edges (Babuska & Suri 1994, sec. 4).

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mesh/planar/prism.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::mesh {

/// A place that needs elements of its own size, such as a contact patch: the disc of radius r about a point in the
/// plane, m.
struct Spot {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  double radius_m = 0.0;
};

/// The fineness of a prism's mesh, by places.
struct PrismMeshOptions {
  double size_m = 0.0;  ///< wanted edge of an element away from borders, in the plane and along a rib's height; above 0
  int layers = 1;       ///< graded layers along every border, 0 to 8; with 0 elements have size_m everywhere
  /// Width of the outermost layer, m. With 0 it is the thickness of the wall beside the border, which is the width of
  /// the boundary layer of torsion. All layers of a border together take at most a third of the way to the opposite
  /// border, and no layer is wider than size_m. There are no layers across a rib, which is thinner than it is high.
  double layer_width_m = 0.0;
  double layer_factor = 0.2;  ///< width of a layer over that of the next one inwards, 0.1 to 0.5
  std::vector<Spot> spots{};  ///< elements as small as the radius there, growing with the distance
  double spot_growth = 1.0;   ///< size of an element over its distance from the spot, 0.2 to 10; 4 suits high orders
};

/// All violations of the options, each in a line of its own; `prism` gives the bounds on lengths.
[[nodiscard]] std::vector<std::string> violations(const PrismMeshOptions& options, const Prism& prism);

/// Wanted edge of an element at p, m: min(size_m, max(r, g |p − c|)) over the spots with centre c, radius r and growth
/// g.
[[nodiscard]] double wanted_size(const PrismMeshOptions& options, const Eigen::Vector2d& p);

/// Distances from a border to the lines between its layers, for an outermost layer of width one: with n layers and the
/// factor q the layer next to the border is q^(n−1) wide. Empty without layers.
[[nodiscard]] std::vector<double> layer_distances(int layers, double factor);

/// The mesh of a part: a planar mesh that conforms to the borders (a tensor grid if all borders run along two axes,
/// otherwise a constrained Delaunay triangulation), swept through the heights. Throws InputError if the part or the
/// options are not valid or if a layer would be narrower than 1e-6 of the part's diagonal; NumericalError if the mesh's
/// volume differs from the part's by more than 1e-12 relative.
[[nodiscard]] TetMesh mesh_prism(const Prism& prism, const PrismMeshOptions& options);

}  // namespace thinwall::mesh

#pragma once
// The thickness of the part beneath its surface.

#include <vector>

#include "mesh/faceted_surface.hpp"
#include "mesh/surface/triangle_tree.hpp"

namespace thinwall::mesh {

/// For each triangle the thickness (m) of the wall beneath its centroid: the median, over a ray along the inward normal
/// and six rays at 15° about it, of (distance to the first triangle met) · cos(angle to the normal). Between parallel
/// faces this is exactly their distance; the median leaves out rays that end in a corner. It follows the shape diameter
/// function (Shapira, Shamir & Cohen-Or 2008), with the projection that makes a plate exact. `tree` holds the same
/// surface. Throws NumericalError if no ray from a triangle meets another one, because the surface is then not closed.
/// Cost O(n log n).
[[nodiscard]] std::vector<double> wall_thickness(const TriangleSurface& surface, const TriangleTree& tree);

/// The area-weighted median of the thickness over the listed triangles, m.
[[nodiscard]] double median_thickness(const TriangleSurface& surface, const std::vector<double>& thickness,
                                      std::vector<int> triangles);

}  // namespace thinwall::mesh

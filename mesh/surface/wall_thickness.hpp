#pragma once
// The thickness of the part beneath its surface.

#include <vector>

#include "mesh/faceted_surface.hpp"
#include "mesh/surface/triangle_tree.hpp"

namespace thinwall::mesh {

/// For each triangle the thickness (m) of the wall beneath its centroid: the median, over a ray along the inward normal
/// and six rays at 15° about it, of (way to the first hit) · cos(angle to the normal). Parallel faces give their
/// distance exactly; the median leaves out rays that run into a corner. In the manner of the shape diameter function
/// (Shapira, Shamir & Cohen-Or 2008), with the projection that makes a plate exact. `tree` holds the same surface.
/// Throws NumericalError if no ray from a triangle hits anything: the surface is not closed. Cost O(n log n).
[[nodiscard]] std::vector<double> wall_thickness(const TriangleSurface& surface, const TriangleTree& tree);

/// The thickness below (and above) which half of the area of the named triangles lies, m.
[[nodiscard]] double median_thickness(const TriangleSurface& surface, const std::vector<double>& thickness,
                                      std::vector<int> triangles);

}  // namespace thinwall::mesh

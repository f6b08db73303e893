#pragma once
// The largest width that the graded layers along each border may have.

#include <vector>

#include "mesh/planar/border_graph.hpp"
#include "mesh/planar/prism_mesh.hpp"

namespace thinwall::mesh {

/// A border walked with the material on its left.
struct BorderSide {
  int border = 0;
  int from = 0;
  int to = 0;
  Extent extent;       ///< of the material on the left
  int next = 0;        ///< the side that follows around the same region
  int previous = 0;    ///< the side before
  double angle = 0.0;  ///< inside the material, between this side and the next, 0 to 2π
  double width = 0.0;  ///< of the outermost layer, m; 0: no layers
};

/// All sides of the borders that have material, linked around their regions; widths not yet set. Cost O(borders²).
[[nodiscard]] std::vector<BorderSide> border_sides(const BorderGraph& graph);

/// True if a side goes on into the next one within 30 degrees: a curve, not a corner.
[[nodiscard]] bool smooth(const BorderSide& side);

/// Unit vectors along a side, and to its left into the material.
[[nodiscard]] Eigen::Vector2d direction(const BorderGraph& graph, const BorderSide& side);
/// See direction().
[[nodiscard]] Eigen::Vector2d inward(const BorderGraph& graph, const BorderSide& side);

/// Length of a side, m.
[[nodiscard]] double length(const BorderGraph& graph, const BorderSide& side);

/// Sets the width of every side's outermost layer: layer_width_m, or else the thickness of the wall, which is the least
/// of its height, the way across and the way along the border; at most size_m; all layers at most a third of the way
/// across. 0 where the way across is the thin one. Throws InputError if a layer would be narrower than `narrowest_m`.
/// Cost O(borders²).
void set_layer_widths(std::vector<BorderSide>& sides, const BorderGraph& graph, const PrismMeshOptions& options,
                      double narrowest_m);

/// Narrows the layers where the feet of a corner would take more than 0.4 of either of its sides; layers that would
/// lose nearly all (at a needle, a notch) or become narrower than `narrowest_m` are dropped.
void fit_corners(std::vector<BorderSide>& sides, const BorderGraph& graph, const PrismMeshOptions& options,
                 double narrowest_m);

/// Distance along `side` from its end to the foot of the point that lies a away from `side` and b away from the next
/// one, at a corner of angle θ: (b + a cos θ) / sin θ. Negative beyond the end.
[[nodiscard]] double corner_foot(double angle, double a, double b);

}  // namespace thinwall::mesh

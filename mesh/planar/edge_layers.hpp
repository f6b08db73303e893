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
  Extent extent;       ///< extent of the material on the left
  int next = 0;        ///< the side that follows around the same region
  int previous = 0;    ///< the side before
  double angle = 0.0;  ///< angle inside the material between this side and the next, 0 to 2π
  double width = 0.0;  ///< width of the outermost layer, m; 0: no layers
};

/// All sides of the borders that have material, linked around their regions, without widths. Cost O(borders²).
[[nodiscard]] std::vector<BorderSide> border_sides(const BorderGraph& graph);

/// True if a side goes on into the next one within 30 degrees, as the pieces of a curve do.
[[nodiscard]] bool smooth(const BorderSide& side);

/// The unit vector along a side.
[[nodiscard]] Eigen::Vector2d direction(const BorderGraph& graph, const BorderSide& side);
/// The unit vector to the left of a side, into the material.
[[nodiscard]] Eigen::Vector2d inward(const BorderGraph& graph, const BorderSide& side);

/// Length of a side, m.
[[nodiscard]] double length(const BorderGraph& graph, const BorderSide& side);

/// Sets the width of every side's outermost layer: layer_width_m if it is given, or else the thickness of the wall,
/// which is the smallest of its height, the distance across to the opposite border, and the length of the border. The
/// width is at most size_m, and all layers of a side together take at most a third of the distance across. It is 0 if
/// the distance across is itself the thickness. Throws InputError if a layer would be narrower than `narrowest_m`. Cost
/// O(borders²).
void set_layer_widths(std::vector<BorderSide>& sides, const BorderGraph& graph, const PrismMeshOptions& options,
                      double narrowest_m);

/// Narrows the layers of two sides that meet in a corner if the feet of the corner (corner_foot()) would take more than
/// 0.4 of either side. Layers that would lose nearly all of their width, as at a needle or a notch, or become narrower
/// than `narrowest_m` are dropped.
void fit_corners(std::vector<BorderSide>& sides, const BorderGraph& graph, const PrismMeshOptions& options,
                 double narrowest_m);

/// Distance along `side` from its end to the foot of the point that lies a away from `side` and b away from the next
/// one, at a corner of angle θ: (b + a cos θ) / sin θ. It is negative if the foot lies beyond the end.
[[nodiscard]] double corner_foot(double angle, double a, double b);

}  // namespace thinwall::mesh

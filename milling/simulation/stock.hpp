#pragma once
// The material before the cut, where its edges are straight.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "milling/cut/engagement.hpp"
#include "milling/cut/tool.hpp"

namespace thinwall::milling {

/// The material lies where normal · P ≤ offset, P in the plane of the cut (x_T, y_T), m, from the place where the
/// centre of the tool that does not vibrate is when the simulation begins.
struct StockEdge {
  Eigen::Vector2d normal = Eigen::Vector2d::UnitY();  ///< unit vector, out of the material
  double offset_m = 0.0;
};

/// The material on the inner side of all its edges; without any, everywhere.
using Stock = std::vector<StockEdge>;

/// The shoulder that the tool leaves at a radial depth, m: its edge lies along the feed, in down-milling above the wall
/// on the −y_T side, y ≤ a − D/2, in up-milling y ≥ D/2 − a. At a = D, a slot, there is no edge. Throws InputError if
/// the radial depth is not positive or exceeds the diameter.
[[nodiscard]] Stock shoulder(const Cutter& cutter, double radial_depth_m, MillingDirection direction);

/// The edge across the feed which the tool, coming from outside, first touches when it has moved on by `ahead_m`, ≥ 0:
/// x ≥ D/2 + ahead.
[[nodiscard]] StockEdge border_ahead(const Cutter& cutter, double ahead_m);

/// A stretch of a ray from the centre of the tool, m from there.
struct RaySpan {
  double from_m = 0.0;
  double to_m = 0.0;  ///< below `from_m` where the ray misses the material
};

/// The stretch within the stock of the ray from `centre` along the unit vector `direction`, not beyond `length_m`.
[[nodiscard]] RaySpan within(const Stock& stock, const Eigen::Vector2d& centre, const Eigen::Vector2d& direction,
                             double length_m);

/// Every violation, empty if there is none: unit normals to 1e-9, finite offsets.
[[nodiscard]] std::vector<std::string> validate(const Stock& stock);

}  // namespace thinwall::milling

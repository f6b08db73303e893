#include "milling/simulation/stock.hpp"

#include <algorithm>
#include <cmath>

namespace thinwall::milling {

Stock shoulder(const Cutter& cutter, double radial_depth_m, MillingDirection direction) {
  (void)engagement_of(cutter, radial_depth_m, direction);  // throws for a radial depth that cannot be
  const double radius = 0.5 * cutter.diameter_m;
  if (radial_depth_m >= cutter.diameter_m) return {};
  const double side = direction == MillingDirection::down ? 1.0 : -1.0;
  return {{Eigen::Vector2d(0.0, side), radial_depth_m - radius}};
}

StockEdge border_ahead(const Cutter& cutter, double ahead_m) {
  return {-Eigen::Vector2d::UnitX(), -(0.5 * cutter.diameter_m + ahead_m)};
}

RaySpan within(const Stock& stock, const Eigen::Vector2d& centre, const Eigen::Vector2d& direction, double length_m) {
  RaySpan span{0.0, length_m};
  for (const StockEdge& edge : stock) {
    const double towards = edge.normal.dot(direction);
    const double inside = edge.offset_m - edge.normal.dot(centre);  // how far the centre lies within the edge
    if (towards > 0.0) {
      span.to_m = std::min(span.to_m, inside / towards);
    } else if (towards < 0.0) {
      span.from_m = std::max(span.from_m, inside / towards);
    } else if (inside < 0.0) {
      return {length_m, 0.0};
    }
  }
  return span;
}

std::vector<std::string> validate(const Stock& stock) {
  std::vector<std::string> violations;
  for (const StockEdge& edge : stock) {
    if (std::abs(edge.normal.norm() - 1.0) <= 1e-9 && std::isfinite(edge.offset_m)) continue;
    violations.emplace_back(
        "stock: an edge has a normal that is no unit vector, or an offset that is not finite; correct it");
  }
  return violations;
}

}  // namespace thinwall::milling

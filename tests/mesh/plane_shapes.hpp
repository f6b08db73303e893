#pragma once
// Polygons for the tests of prismatic parts, m.

#include <cmath>
#include <numbers>

#include "mesh/planar/prism.hpp"

namespace thinwall::mesh {

inline Polygon rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

/// Regular polygon with n corners on the circle.
inline Polygon regular(const Eigen::Vector2d& centre, double radius, int n) {
  Polygon polygon;
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / n;
    polygon.emplace_back(centre + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return polygon;
}

inline double regular_area(double radius, int n) {
  return 0.5 * n * radius * radius * std::sin(2.0 * std::numbers::pi / n);
}

inline Polygon turned(Polygon polygon, double angle) {
  for (auto& p : polygon)
    p = Eigen::Vector2d(std::cos(angle) * p.x() - std::sin(angle) * p.y(),
                        std::sin(angle) * p.x() + std::cos(angle) * p.y());
  return polygon;
}

inline Prism turned(Prism prism, double angle) {
  prism.outline = turned(prism.outline, angle);
  for (auto& hole : prism.holes) hole = turned(hole, angle);
  for (auto& zone : prism.zones) zone.outline = turned(zone.outline, angle);
  return prism;
}

inline Prism flat_plate() {
  return {rectangle(0, 0, 0.45, 0.1), {}, 0.0, 0.006, {}};
}

/// Floor 100 × 60 × 3 mm with walls 2 mm thick and 40 mm high along two sides, which meet in a corner.
inline Prism pocket_corner() {
  return {rectangle(0, 0, 0.1, 0.06),
          {},
          0.0,
          0.003,
          {{rectangle(0, 0, 0.1, 0.002), 0.0, 0.043}, {rectangle(0, 0, 0.002, 0.06), 0.0, 0.043}}};
}

}  // namespace thinwall::mesh

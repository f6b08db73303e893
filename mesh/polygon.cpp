#include "mesh/polygon.hpp"

#include <algorithm>
#include <cmath>

namespace thinwall::mesh {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  // The compiler may fuse one of the products with the difference, which then is what the other one was rounded by:
  // not 0 for a = b. The second line takes that rounding back.
  const double product = a.y() * b.x();
  const double rounding = std::fma(-a.y(), b.x(), product);
  return std::fma(a.x(), b.y(), -product) + rounding;
}

double signed_area(const Polygon& polygon) {
  double twice = 0.0;  // about the first corner, so that a polygon far from the origin loses no digits
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    twice += cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  return 0.5 * twice;
}

Segment edge(const Polygon& polygon, std::size_t i) {
  return {polygon[i], polygon[(i + 1) % polygon.size()]};
}

bool contains(const Polygon& polygon, const Eigen::Vector2d& p) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto [a, b] = edge(polygon, i);
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

double distance(const Segment& segment, const Eigen::Vector2d& p) {
  const Eigen::Vector2d along = segment[1] - segment[0];
  const double squared = along.squaredNorm();
  const double t = squared > 0.0 ? std::clamp((p - segment[0]).dot(along) / squared, 0.0, 1.0) : 0.0;
  return (p - segment[0] - t * along).norm();
}

double distance(const Segment& a, const Segment& b) {
  if (crossing(a, b)) return 0.0;
  return std::min({distance(a, b[0]), distance(a, b[1]), distance(b, a[0]), distance(b, a[1])});
}

std::optional<Eigen::Vector2d> crossing(const Segment& a, const Segment& b) {
  const Eigen::Vector2d u = a[1] - a[0];
  const Eigen::Vector2d v = b[1] - b[0];
  const double b0 = cross(u, b[0] - a[0]);
  const double b1 = cross(u, b[1] - a[0]);
  const double a0 = cross(v, a[0] - b[0]);
  const double a1 = cross(v, a[1] - b[0]);
  if (!((b0 < 0.0 && b1 > 0.0) || (b0 > 0.0 && b1 < 0.0))) return std::nullopt;
  if (!((a0 < 0.0 && a1 > 0.0) || (a0 > 0.0 && a1 < 0.0))) return std::nullopt;
  Eigen::Vector2d p = b[0] + b0 / (b0 - b1) * v;
  for (int axis = 0; axis < 2; ++axis) {  // on a line along an axis the point gets its coordinate without round-off
    if (u[axis] == 0.0) p[axis] = a[0][axis];
    if (v[axis] == 0.0) p[axis] = b[0][axis];
  }
  // For two segments on one line the signs above are round-off, and the segments may be far apart.
  if (distance(a, p) > 1e-9 * (u.norm() + v.norm())) return std::nullopt;
  return p;
}

}  // namespace thinwall::mesh

#pragma once
// Closed surfaces with volumes in closed form, for tests of files and repairs.

#include <cmath>
#include <numbers>

#include "mesh/surface/shapes.hpp"
#include "mesh/triangle_soup.hpp"

namespace thinwall::mesh {

/// A torus about the z axis, cut into n sections of m corners. With regular polygons as sections at equal angles the
/// volume is that of n equal wedges; the test compares with mesh::volume, not with 2π²Rr².
inline TriangleSurface torus(double ring_radius_m, double tube_radius_m, int n, int m) {
  TriangleSurface result;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) {
      const double a = 2 * std::numbers::pi * i / n;
      const double b = 2 * std::numbers::pi * j / m;
      const double r = ring_radius_m + tube_radius_m * std::cos(b);
      result.vertices.emplace_back(r * std::cos(a), r * std::sin(a), tube_radius_m * std::sin(b));
    }
  }
  const auto at = [&](int i, int j) { return (i % n) * m + j % m; };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) {
      result.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      result.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return result;
}

/// A plate 128 × 64 × 16 mm with two by one pockets from above, walls of 4 mm and a floor of 2 mm, all in 1/1024 m, so
/// that single precision and decimal text hold every coordinate.
inline TriangleSurface pocketed_rib() {
  constexpr double step = 1.0 / 1024;
  GridLines lines;
  for (const int x : {0, 4, 32, 62, 66, 96, 124, 128}) lines.x.push_back(step * x);
  for (const int y : {0, 4, 32, 60, 64}) lines.y.push_back(step * y);
  for (const int z : {0, 2, 16}) lines.z.push_back(step * z);
  const auto is_filled = [](int i, int j, int k) {
    const bool in_pocket = k == 1 && (j == 1 || j == 2) && (i == 1 || i == 2 || i == 4 || i == 5);
    return !in_pocket;
  };
  return grid_surface(lines, is_filled);
}

/// 128 · 64 · 16 less two pockets of 58 · 56 · 14 in (1/1024 m)³.
inline double pocketed_rib_volume() {
  return (128.0 * 64 * 16 - 2 * 58.0 * 56 * 14) / (1024.0 * 1024 * 1024);
}

/// Both in one, the second moved.
inline TriangleSoup together(const TriangleSurface& a, const TriangleSurface& b, const Eigen::Vector3d& by) {
  TriangleSoup result = soup(a);
  const int offset = static_cast<int>(a.vertices.size());
  for (const auto& x : b.vertices) result.points.emplace_back(x + by);
  for (const auto& t : b.triangles) result.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  return result;
}

}  // namespace thinwall::mesh

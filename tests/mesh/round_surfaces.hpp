#pragma once
// Closed surfaces of round bodies, whose facets have their vertices on the true surface.

#include <cmath>
#include <numbers>

#include "mesh/faceted_surface.hpp"

namespace thinwall::mesh::testing {

/// A torus about z: radius of the ring, radius of its section, and the number of facets around each.
inline TriangleSurface torus_surface(double ring_m, double section_m, int around, int about) {
  TriangleSurface result;
  for (int i = 0; i < around; ++i) {
    for (int k = 0; k < about; ++k) {
      const double u = 2.0 * std::numbers::pi * i / around, v = 2.0 * std::numbers::pi * k / about;
      const double r = ring_m + section_m * std::cos(v);
      result.vertices.emplace_back(r * std::cos(u), r * std::sin(u), section_m * std::sin(v));
    }
  }
  const auto at = [&](int i, int k) { return (i % around) * about + k % about; };
  for (int i = 0; i < around; ++i) {
    for (int k = 0; k < about; ++k) {
      result.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      result.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  }
  return result;
}

/// A ball by latitudes: `rings` from pole to pole and twice as many facets around.
inline TriangleSurface ball_surface(double radius_m, int rings) {
  TriangleSurface result;
  const int around = 2 * rings;
  result.vertices.emplace_back(0.0, 0.0, radius_m);
  for (int i = 1; i < rings; ++i) {
    for (int k = 0; k < around; ++k) {
      const double polar = std::numbers::pi * i / rings, u = 2.0 * std::numbers::pi * k / around;
      result.vertices.emplace_back(radius_m * std::sin(polar) * std::cos(u), radius_m * std::sin(polar) * std::sin(u),
                                   radius_m * std::cos(polar));
    }
  }
  result.vertices.emplace_back(0.0, 0.0, -radius_m);
  const int last = static_cast<int>(result.vertices.size()) - 1;
  const auto at = [&](int i, int k) { return i == 0 ? 0 : i == rings ? last : 1 + (i - 1) * around + k % around; };
  for (int i = 0; i < rings; ++i) {
    for (int k = 0; k < around; ++k) {
      if (i > 0) result.triangles.push_back({at(i, k), at(i + 1, k), at(i, k + 1)});
      if (i + 1 < rings) result.triangles.push_back({at(i, k + 1), at(i + 1, k), at(i + 1, k + 1)});
    }
  }
  return result;
}

}  // namespace thinwall::mesh::testing

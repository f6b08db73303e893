#include "mesh/surface/surface_features.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <vector>

#include "core/error.hpp"
#include "mesh/surface/edge_uses.hpp"

namespace thinwall::mesh {

namespace {

using Edge = std::array<int, 2>;

/// The triangle beyond each edge of each triangle, the edge k from corner k to the next one.
std::vector<std::array<int, 3>> triangles_beyond(const TriangleSurface& surface, const std::vector<EdgeUse>& uses) {
  std::vector<std::array<int, 3>> result(surface.triangles.size());
  for_each_edge(uses, [&](std::span<const EdgeUse> both) {
    if (both.size() != 2) throw core::InputError("the features of a surface that is not closed are not known; mend it");
    for (std::size_t side = 0; side < 2; ++side) {
      const EdgeUse& use = both[side];
      const auto& v = surface.triangles[static_cast<std::size_t>(use.triangle)];
      const int from = use.ends[use.is_forward ? 0 : 1];
      const std::size_t k = v[0] == from ? 0 : v[1] == from ? 1 : 2;
      result[static_cast<std::size_t>(use.triangle)][k] = both[1 - side].triangle;
    }
  });
  return result;
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// The sharp edges, each once, with the triangles on both sides, the left one first.
std::map<Edge, Edge> sharp_edges(const TriangleSurface& surface, const std::vector<EdgeUse>& uses, double angle) {
  std::map<Edge, Edge> result;
  for_each_edge(uses, [&](std::span<const EdgeUse> both) {
    const bool first_is_left = both[0].is_forward;
    const int left = both[first_is_left ? 0 : 1].triangle, right = both[first_is_left ? 1 : 0].triangle;
    if (angle_between(area_vector(surface, left), area_vector(surface, right)) > angle)
      result.emplace_hint(result.end(), both[0].ends, Edge{left, right});
  });
  return result;
}

/// Numbers the patches by flooding from triangle to triangle but over borders, is_border(triangle, edge of it, triangle
/// beyond); returns how many there are.
template <class IsBorder>
int flood(const std::vector<std::array<int, 3>>& beyond, const IsBorder& is_border, std::vector<int>& patch) {
  patch.assign(beyond.size(), -1);
  int patches = 0;
  for (std::size_t seed = 0; seed < patch.size(); ++seed) {
    if (patch[seed] >= 0) continue;
    std::vector<int> waiting{static_cast<int>(seed)};
    patch[seed] = patches;
    while (!waiting.empty()) {
      const int here = waiting.back();
      waiting.pop_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const int next = beyond[static_cast<std::size_t>(here)][k];
        if (patch[static_cast<std::size_t>(next)] >= 0 || is_border(here, k, next)) continue;
        patch[static_cast<std::size_t>(next)] = patches;
        waiting.push_back(next);
      }
    }
    ++patches;
  }
  return patches;
}

/// The patches between sharp edges; returns how many there are.
int flood_between(const TriangleSurface& surface, const std::vector<std::array<int, 3>>& beyond,
                  const std::map<Edge, Edge>& sharp, std::vector<int>& patch) {
  const auto is_sharp = [&](int here, std::size_t k, int) {
    const auto& v = surface.triangles[static_cast<std::size_t>(here)];
    const int a = v[k], b = v[(k + 1) % 3];
    return sharp.contains({std::min(a, b), std::max(a, b)});
  };
  return flood(beyond, is_sharp, patch);
}

/// For each plane, true if it is no sliver: rounded coordinates turn the normals of slivers of a plane face.
std::vector<bool> wide_planes(const TriangleSurface& surface, const std::vector<int>& plane, int planes) {
  constexpr double narrow = 1e-3;  // of the part's diagonal
  std::vector<double> area(static_cast<std::size_t>(planes), 0.0);
  std::vector<Eigen::AlignedBox3d> box(area.size());
  for (std::size_t t = 0; t < plane.size(); ++t) {
    const auto p = static_cast<std::size_t>(plane[t]);
    area[p] += area_vector(surface, static_cast<int>(t)).norm();
    for (const int v : surface.triangles[t]) box[p].extend(surface.vertices[static_cast<std::size_t>(v)]);
  }
  const double least_m = narrow * diagonal(surface);
  std::vector<bool> is_wide(area.size());
  for (std::size_t p = 0; p < area.size(); ++p) is_wide[p] = area[p] > least_m * box[p].sizes().norm();
  return is_wide;
}

/// The wide planes of which each patch consists, by the number of the plane of each triangle; not more than `most` + 1.
std::vector<std::set<int>> planes_of(const std::vector<int>& patch, int patches, const std::vector<int>& plane,
                                     const std::vector<bool>& is_wide, std::size_t most) {
  std::vector<std::set<int>> result(static_cast<std::size_t>(patches));
  for (std::size_t t = 0; t < patch.size(); ++t) {
    if (!is_wide[static_cast<std::size_t>(plane[t])]) continue;
    if (auto& planes = result[static_cast<std::size_t>(patch[t])]; planes.size() <= most) planes.insert(plane[t]);
  }
  return result;
}

/// The sharp edges, and the creases of patches that consist of two to four wide planes: such a patch is no tessellated
/// curve but has a ridge or a bevel, whose corners elements across it would cut off.
std::map<Edge, Edge> with_creases(const TriangleSurface& surface, const std::vector<EdgeUse>& uses,
                                  const std::vector<std::array<int, 3>>& beyond, std::map<Edge, Edge> sharp) {
  constexpr double plane_rad = 1e-3;
  constexpr std::size_t most_planes = 4;
  std::vector<int> patch, plane;
  const int patches = flood_between(surface, beyond, sharp, patch);
  const auto is_crease = [&](int here, std::size_t, int next) {
    return angle_between(area_vector(surface, here), area_vector(surface, next)) > plane_rad;
  };
  const std::vector<bool> is_wide = wide_planes(surface, plane, flood(beyond, is_crease, plane));
  const auto planes = planes_of(patch, patches, plane, is_wide, most_planes);
  for_each_edge(uses, [&](std::span<const EdgeUse> both) {
    const bool first_is_left = both[0].is_forward;
    const Edge sides{both[first_is_left ? 0 : 1].triangle, both[first_is_left ? 1 : 0].triangle};
    const auto left = static_cast<std::size_t>(sides[0]), right = static_cast<std::size_t>(sides[1]);
    if (patch[left] != patch[right] || plane[left] == plane[right]) return;
    if (!is_wide[static_cast<std::size_t>(plane[left])] || !is_wide[static_cast<std::size_t>(plane[right])]) return;
    if (planes[static_cast<std::size_t>(patch[left])].size() <= most_planes) sharp.emplace(both[0].ends, sides);
  });
  return sharp;
}

std::vector<bool> corners(const TriangleSurface& surface, const std::vector<std::vector<int>>& neighbours,
                          double angle) {
  std::vector<bool> is_corner(surface.vertices.size(), false);
  for (std::size_t v = 0; v < neighbours.size(); ++v) {
    const auto& next = neighbours[v];
    if (next.empty()) continue;
    const auto to = [&](std::size_t k) {
      return Eigen::Vector3d(surface.vertices[static_cast<std::size_t>(next[k])] - surface.vertices[v]);
    };
    is_corner[v] = next.size() != 2 || angle_between(to(0), -to(1)) > angle;
  }
  return is_corner;
}

/// The vertices of the line that begins with `from` and `to`, up to a corner or back to the start.
std::vector<int> walk(int from, int to, const std::vector<std::vector<int>>& neighbours,
                      const std::vector<bool>& is_corner) {
  std::vector<int> line{from, to};
  while (!is_corner[static_cast<std::size_t>(line.back())] && line.back() != from) {
    const auto& next = neighbours[static_cast<std::size_t>(line.back())];
    line.push_back(next[0] == line[line.size() - 2] ? next[1] : next[0]);
  }
  return line;
}

}  // namespace

SurfaceFeatures surface_features(const TriangleSurface& surface, double sharp_angle_rad) {
  const std::vector<EdgeUse> uses = sorted_edges(surface.triangles);
  const auto beyond = triangles_beyond(surface, uses);
  const auto sharp = with_creases(surface, uses, beyond, sharp_edges(surface, uses, sharp_angle_rad));
  SurfaceFeatures result;
  result.patches = flood_between(surface, beyond, sharp, result.patch_of_triangle);
  std::vector<std::vector<int>> neighbours(surface.vertices.size());
  for (const auto& [edge, sides] : sharp) {
    neighbours[static_cast<std::size_t>(edge[0])].push_back(edge[1]);
    neighbours[static_cast<std::size_t>(edge[1])].push_back(edge[0]);
  }
  result.is_corner = corners(surface, neighbours, sharp_angle_rad);
  std::map<Edge, bool> walked;
  const auto key = [](int a, int b) { return Edge{std::min(a, b), std::max(a, b)}; };
  const auto add_line = [&](int from, int to) {
    if (walked[key(from, to)]) return;
    FeatureLine line{walk(from, to, neighbours, result.is_corner), {}};
    for (std::size_t i = 0; i + 1 < line.vertices.size(); ++i)
      walked[key(line.vertices[i], line.vertices[i + 1])] = true;
    const auto& sides = sharp.at(key(from, to));
    for (std::size_t k = 0; k < 2; ++k) line.patches[k] = result.patch_of_triangle[static_cast<std::size_t>(sides[k])];
    result.lines.push_back(std::move(line));
  };
  // Lines that begin at corners are walked first; the sharp edges that are left form closed lines without a corner.
  for (const bool from_corners : {true, false}) {
    for (std::size_t v = 0; v < neighbours.size(); ++v) {
      if (from_corners && !result.is_corner[v]) continue;
      for (const int to : neighbours[v]) add_line(static_cast<int>(v), to);
    }
  }
  return result;
}

}  // namespace thinwall::mesh

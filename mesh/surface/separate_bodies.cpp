#include "mesh/surface/separate_bodies.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <span>
#include <tuple>

#include "mesh/faceted_surface.hpp"
#include "mesh/pieces.hpp"
#include "mesh/surface/edge_uses.hpp"

namespace thinwall::mesh {

namespace {

using Pair = std::array<int, 2>;

constexpr double equal_angles_rad = 1e-6;

const Eigen::Vector3d& point(const TriangleSoup& soup, int p) {
  return soup.points[static_cast<std::size_t>(p)];
}

/// A triangle at an edge, by its angle about the edge. A body begins at a triangle that looks down the angle, and ends
/// at one that looks up.
struct Side {
  double angle = 0.0;
  bool begins = false;
  int triangle = 0;
  int group = 0;  // of sides at one angle
};

/// The triangles at an edge by ascending angle; of those at one angle, the ones at which bodies end come first.
std::vector<Side> sides_of(const TriangleSoup& soup, std::span<const EdgeUse> uses) {
  const Eigen::Vector3d& from = point(soup, uses[0].ends[0]);
  const Eigen::Vector3d axis = (point(soup, uses[0].ends[1]) - from).normalized();
  std::vector<Side> sides;
  Eigen::Vector3d across = Eigen::Vector3d::Zero();
  for (const EdgeUse& use : uses) {
    const auto& corners = soup.triangles[static_cast<std::size_t>(use.triangle)];
    const int third = *std::ranges::find_if(corners, [&](int p) { return std::ranges::count(use.ends, p) == 0; });
    Eigen::Vector3d d = point(soup, third) - from;
    d -= axis * axis.dot(d);
    if (sides.empty()) across = d;
    double angle = std::atan2(axis.dot(across.cross(d)), across.dot(d));
    if (angle < -equal_angles_rad) angle += 2.0 * std::numbers::pi;
    sides.push_back({angle, !use.is_forward, use.triangle});
  }
  std::ranges::sort(sides, {}, &Side::angle);
  for (std::size_t i = 1; i < sides.size(); ++i)
    sides[i].group = sides[i - 1].group + (sides[i].angle - sides[i - 1].angle > equal_angles_rad ? 1 : 0);
  std::ranges::stable_sort(sides, {}, [](const Side& s) { return std::tuple(s.group, s.begins); });
  return sides;
}

/// True if as many triangles use the edge forwards as backwards, as those of closed bodies do.
bool is_balanced(std::span<const EdgeUse> uses) {
  return 2 * std::ranges::count(uses, true, &EdgeUse::is_forward) == std::ssize(uses);
}

/// The pairs of triangles between which a body lies at a balanced edge; empty if the bodies overlap there or face each
/// other, so that angles do not tell which triangles belong together.
std::vector<Pair> wedges(const TriangleSoup& soup, std::span<const EdgeUse> uses) {
  if (uses.size() == 2) return {{uses[0].triangle, uses[1].triangle}};
  std::vector<Side> sides = sides_of(soup, uses);
  if (!sides.front().begins) std::rotate(sides.begin(), sides.begin() + 1, sides.end());
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < sides.size(); i += 2) {
    if (!sides[i].begins || sides[i + 1].begins) return {};
    pairs.push_back({sides[i].triangle, sides[i + 1].triangle});
  }
  return pairs;
}

/// The wedges at all edges; none if the soup is not one of closed bodies.
std::optional<std::vector<Pair>> all_wedges(const TriangleSoup& soup) {
  std::vector<Pair> all;
  bool is_sound = true;
  for_each_edge(sorted_edges(soup.triangles), [&](std::span<const EdgeUse> uses) {
    is_sound = is_sound && is_balanced(uses);
    if (!is_sound) return;
    const std::vector<Pair> pairs = wedges(soup, uses);
    all.insert(all.end(), pairs.begin(), pairs.end());
  });
  return is_sound ? std::optional(std::move(all)) : std::nullopt;
}

/// The triangles with the points that they use. `number`: −1 for each point of the soup, as it is left.
TriangleSoup with_own_points(const TriangleSoup& soup, const std::vector<std::array<int, 3>>& triangles,
                             std::vector<int>& number) {
  TriangleSoup result{{}, triangles};
  for (auto& corners : result.triangles) {
    for (int& p : corners) {
      int& own = number[static_cast<std::size_t>(p)];
      if (own < 0) {
        own = static_cast<int>(result.points.size());
        result.points.push_back(point(soup, p));
      }
      p = own;
    }
  }
  for (const auto& corners : triangles)
    for (const int p : corners) number[static_cast<std::size_t>(p)] = -1;
  return result;
}

bool is_a_body(const TriangleSoup& soup) {
  bool is_manifold = true;
  for_each_edge(sorted_edges(soup.triangles), [&](std::span<const EdgeUse> uses) {
    is_manifold = is_manifold && uses.size() == 2 && is_balanced(uses);
  });
  return is_manifold && volume(TriangleSurface{soup.points, soup.triangles}) > 0.0;
}

}  // namespace

std::vector<TriangleSoup> separate_bodies(const TriangleSoup& soup) {
  const auto pairs = all_wedges(soup);
  if (!pairs || pairs->empty()) return {};
  const std::vector<int> piece = pieces(static_cast<int>(soup.triangles.size()), *pairs);
  std::vector<int> body_of(piece.size(), -1);
  std::vector<std::vector<std::array<int, 3>>> triangles;
  for (std::size_t t = 0; t < piece.size(); ++t) {
    int& body = body_of[static_cast<std::size_t>(piece[t])];
    if (body < 0) {
      body = static_cast<int>(triangles.size());
      triangles.emplace_back();
    }
    triangles[static_cast<std::size_t>(body)].push_back(soup.triangles[t]);
  }
  std::vector<TriangleSoup> bodies;
  std::vector<int> number(soup.points.size(), -1);
  for (const auto& own : triangles) {
    bodies.push_back(with_own_points(soup, own, number));
    if (!is_a_body(bodies.back())) return {};
  }
  return bodies;
}

}  // namespace thinwall::mesh

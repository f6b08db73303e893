#include "mesh/surface/orientation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

#include "mesh/pieces.hpp"
#include "mesh/surface/edge_uses.hpp"

namespace thinwall::mesh {

namespace {

const Eigen::Vector3d& corner(const TriangleSoup& soup, std::size_t triangle, std::size_t k) {
  return soup.points[static_cast<std::size_t>(soup.triangles[triangle][k])];
}

/// Sets of connected triangles (union-find), each of which is turned or not against the first of its set. turned_[t] is
/// relative to parent_[t].
class TurnedSets {
 public:
  explicit TurnedSets(std::size_t count) : parent_(count), turned_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  /// The first of the set, and true if t is turned against it. The path to the first is shortened for later searches.
  std::pair<int, bool> find(int t) {
    int root = t;
    bool parity = false;
    while (parent_[index(root)] != root) {
      parity ^= turned_[index(root)];
      root = parent_[index(root)];
    }
    bool rest = parity;
    while (parent_[index(t)] != root && t != root) {
      const int next = parent_[index(t)];
      const bool step = turned_[index(t)];
      parent_[index(t)] = root;
      turned_[index(t)] = rest;
      rest ^= step;
      t = next;
    }
    return {root, parity};
  }

  /// Records that a and b are turned against each other, or not. False if that contradicts what was recorded before.
  bool join(int a, int b, bool turned) {
    auto [root_a, parity_a] = find(a);
    auto [root_b, parity_b] = find(b);
    if (root_a == root_b) return (parity_a ^ parity_b) == turned;
    if (root_a > root_b) std::swap(root_a, root_b);
    parent_[index(root_b)] = root_a;
    turned_[index(root_b)] = static_cast<bool>(parity_a ^ parity_b ^ turned);
    return true;
  }

 private:
  static std::size_t index(int t) { return static_cast<std::size_t>(t); }

  std::vector<int> parent_;
  std::vector<bool> turned_;
};

/// Numbers the shells in the order of their first triangles, and turns all triangles to agree with the first.
void number_shells(TriangleSoup& soup, TurnedSets& sets, std::vector<bool>& is_turned, Orientation& result) {
  std::vector<int> number(soup.triangles.size(), -1);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const auto [root, turned] = sets.find(static_cast<int>(t));
    int& shell = number[static_cast<std::size_t>(root)];
    if (shell < 0) {
      shell = static_cast<int>(result.volumes_m3.size());
      result.volumes_m3.push_back(0.0);
    }
    result.shell_of_triangle[t] = shell;
    is_turned[t] = turned;
    if (turned) std::swap(soup.triangles[t][1], soup.triangles[t][2]);
  }
}

/// Adds up the volumes of the shells by the divergence theorem, each about the first corner of its shell, so that a
/// shell far from the origin loses no digits.
void measure_shells(const TriangleSoup& soup, Orientation& result) {
  std::vector<const Eigen::Vector3d*> origin(result.volumes_m3.size(), nullptr);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const auto shell = static_cast<std::size_t>(result.shell_of_triangle[t]);
    if (origin[shell] == nullptr) origin[shell] = &corner(soup, t, 0);
    const Eigen::Vector3d a = corner(soup, t, 0) - *origin[shell];
    const Eigen::Vector3d b = corner(soup, t, 1) - *origin[shell];
    result.volumes_m3[shell] += a.dot(b.cross(corner(soup, t, 2) - *origin[shell])) / 6.0;
  }
}

}  // namespace

Orientation orient(TriangleSoup& soup) {
  Orientation result{{.what = "facets turned over"},
                     {.what = "edges across which no orientation fits",
                      .remedy = "the surface is one-sided; give one that encloses a body"},
                     std::vector<int>(soup.triangles.size()),
                     {}};
  TurnedSets sets(soup.triangles.size());
  for_each_edge(sorted_edges(soup.triangles), [&](std::span<const EdgeUse> uses) {
    if (uses.size() != 2 || sets.join(uses[0].triangle, uses[1].triangle, uses[0].is_forward == uses[1].is_forward))
      return;
    const auto at = [&](std::size_t k) { return soup.points[static_cast<std::size_t>(uses[0].ends[k])]; };
    result.one_sided.add(0.5 * (at(0) + at(1)));
  });
  std::vector<bool> is_turned(soup.triangles.size());
  number_shells(soup, sets, is_turned, result);
  measure_shells(soup, result);
  // A shell of negative volume is turned inwards as a whole.
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    if (result.volumes_m3[static_cast<std::size_t>(result.shell_of_triangle[t])] < 0.0) {
      std::swap(soup.triangles[t][1], soup.triangles[t][2]);
      is_turned[t] = !is_turned[t];
    }
    if (is_turned[t]) result.turned.add((corner(soup, t, 0) + corner(soup, t, 1) + corner(soup, t, 2)) / 3.0);
  }
  for (double& v : result.volumes_m3) v = std::abs(v);
  return result;
}

SurfaceFinding touching_vertices(const TriangleSoup& soup) {
  SurfaceFinding finding{.what = "points in which parts of the surface touch", .remedy = "separate or join the parts"};
  const auto corner_of = [&](int triangle, int p) {
    const auto& t = soup.triangles[static_cast<std::size_t>(triangle)];
    return 3 * triangle + static_cast<int>(std::find(t.begin(), t.end(), p) - t.begin());
  };
  // Corners of triangles that share an edge at a point belong to one fan; a point with corners of two fans is one in
  // which parts touch.
  std::vector<std::array<int, 2>> together;
  for_each_edge(sorted_edges(soup.triangles), [&](std::span<const EdgeUse> uses) {
    if (uses.size() != 2) return;
    for (const int p : uses[0].ends)
      together.push_back({corner_of(uses[0].triangle, p), corner_of(uses[1].triangle, p)});
  });
  const auto fan = pieces(3 * static_cast<int>(soup.triangles.size()), together);
  std::vector<int> fan_of_point(soup.points.size(), -1);
  std::vector<bool> is_found(soup.points.size());
  for (std::size_t i = 0; i < fan.size(); ++i) {
    const auto p = static_cast<std::size_t>(soup.triangles[i / 3][i % 3]);
    if (fan_of_point[p] < 0) fan_of_point[p] = fan[i];
    if (fan_of_point[p] == fan[i] || is_found[p]) continue;
    is_found[p] = true;
    finding.add(soup.points[p]);
  }
  return finding;
}

double winding_number(const TriangleSoup& soup, const std::vector<int>& shell_of_triangle, int shell,
                      const Eigen::Vector3d& x_m) {
  double sum = 0.0;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    if (shell_of_triangle[t] != shell) continue;
    const Eigen::Vector3d a = corner(soup, t, 0) - x_m;
    const Eigen::Vector3d b = corner(soup, t, 1) - x_m;
    const Eigen::Vector3d c = corner(soup, t, 2) - x_m;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    sum += 2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4.0 * std::numbers::pi);
}

}  // namespace thinwall::mesh

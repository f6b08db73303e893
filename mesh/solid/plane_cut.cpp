#include "mesh/solid/plane_cut.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace thinwall::mesh {

namespace {

using CutEdge = std::pair<int, int>;

constexpr std::array<std::array<int, 2>, 6> ends_of_edges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

Eigen::Vector3d vertex_at(const TetMesh& mesh, int vertex) {
  return mesh.vertices[static_cast<std::size_t>(vertex)];
}

/// Signed distances (m) of the vertices from the plane, 0 for those that count as on it.
std::vector<double> sides_of(const TetMesh& mesh, const PlaneRegion& plane) {
  std::vector<double> longest(mesh.vertices.size(), 0.0), side(mesh.vertices.size());
  for (const auto& tet : mesh.tets) {
    for (const auto& [i, j] : ends_of_edges) {
      const int a = tet[static_cast<std::size_t>(i)], b = tet[static_cast<std::size_t>(j)];
      const double length = (vertex_at(mesh, a) - vertex_at(mesh, b)).norm();
      for (const int v : {a, b})
        longest[static_cast<std::size_t>(v)] = std::max(longest[static_cast<std::size_t>(v)], length);
    }
  }
  const Eigen::Vector3d n = plane.normal.normalized();
  for (std::size_t v = 0; v < side.size(); ++v) {
    side[v] = (mesh.vertices[v] - plane.point).dot(n);
    if (std::abs(side[v]) <= 1e-3 * longest[v]) side[v] = 0.0;
  }
  return side;
}

/// The tetrahedron's first edge, in the order of its vertices' numbers, whose ends lie on different sides.
std::optional<CutEdge> first_crossing(const std::array<int, 4>& tet, const std::vector<double>& side) {
  std::optional<CutEdge> first;
  for (const auto& [i, j] : ends_of_edges) {
    const auto [a, b] = std::minmax(tet[static_cast<std::size_t>(i)], tet[static_cast<std::size_t>(j)]);
    const CutEdge edge{a, b};
    if (side[static_cast<std::size_t>(a)] * side[static_cast<std::size_t>(b)] < 0.0 && (!first || edge < *first))
      first = edge;
  }
  return first;
}

}  // namespace

TetMesh cut_along(const TetMesh& mesh, const PlaneRegion& plane) {
  TetMesh result{mesh.vertices, {}};
  std::vector<double> side = sides_of(mesh, plane);
  std::map<CutEdge, int> middle_of;
  std::vector<std::array<int, 4>> open = mesh.tets;
  std::reverse(open.begin(), open.end());
  // Each step bisects one tetrahedron at its first crossing edge. Both parts go back on the stack until none of their
  // edges crosses; the new vertex lies on the plane, so that the number of crossing edges falls with each step.
  while (!open.empty()) {
    const std::array<int, 4> tet = open.back();
    open.pop_back();
    const std::optional<CutEdge> edge = first_crossing(tet, side);
    if (!edge) {
      result.tets.push_back(tet);
      continue;
    }
    const auto [a, b] = *edge;
    const auto [found, is_new] = middle_of.try_emplace(*edge, static_cast<int>(result.vertices.size()));
    if (is_new) {
      const double of_a = std::abs(side[static_cast<std::size_t>(a)]),
                   of_b = std::abs(side[static_cast<std::size_t>(b)]);
      result.vertices.emplace_back((of_b * vertex_at(result, a) + of_a * vertex_at(result, b)) / (of_a + of_b));
      side.push_back(0.0);
    }
    std::array<int, 4> with_a = tet, with_b = tet;
    std::replace(with_a.begin(), with_a.end(), b, found->second);
    std::replace(with_b.begin(), with_b.end(), a, found->second);
    open.push_back(with_b);
    open.push_back(with_a);
  }
  return result;
}

}  // namespace thinwall::mesh

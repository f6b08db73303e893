#include "mesh/solid/plane_cut.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "mesh/solid/edge_division.hpp"

namespace thinwall::mesh {

namespace {

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

}  // namespace

TetMesh cut_along(const TetMesh& mesh, const PlaneRegion& plane) {
  const std::vector<double> side = sides_of(mesh, plane);
  std::map<VertexEdge, Eigen::Vector3d> crossings;
  for (const auto& tet : mesh.tets) {
    for (const auto& [i, j] : ends_of_edges) {
      const auto [a, b] = std::minmax(tet[static_cast<std::size_t>(i)], tet[static_cast<std::size_t>(j)]);
      const double of_a = side[static_cast<std::size_t>(a)], of_b = side[static_cast<std::size_t>(b)];
      if (of_a * of_b < 0.0)
        crossings[{a, b}] = (of_b * vertex_at(mesh, a) - of_a * vertex_at(mesh, b)) / (of_b - of_a);
    }
  }
  return divided_at(mesh, crossings);
}

}  // namespace thinwall::mesh

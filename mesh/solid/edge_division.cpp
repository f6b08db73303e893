#include "mesh/solid/edge_division.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace thinwall::mesh {

namespace {

using VertexOn = std::map<VertexEdge, int>;

/// The tetrahedron's first divided edge in the order of its vertices' numbers.
std::optional<VertexEdge> first_divided(const std::array<int, 4>& tet, const VertexOn& vertex_on) {
  std::optional<VertexEdge> first;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      const VertexEdge edge(std::min(tet[i], tet[j]), std::max(tet[i], tet[j]));
      if ((!first || edge < *first) && vertex_on.contains(edge)) first = edge;
    }
  }
  return first;
}

}  // namespace

TetMesh divided_at(const TetMesh& mesh, const std::map<VertexEdge, Eigen::Vector3d>& points) {
  TetMesh result{mesh.vertices, {}};
  VertexOn vertex_on;
  for (const auto& [edge, point] : points) {
    vertex_on[edge] = static_cast<int>(result.vertices.size());
    result.vertices.push_back(point);
  }
  std::vector<std::array<int, 4>> open(mesh.tets.rbegin(), mesh.tets.rend());
  // Each step bisects one tetrahedron at its first divided edge. Both parts go back on the stack until they have none:
  // edges at a new vertex are not divided, so that their number falls with each step.
  while (!open.empty()) {
    const std::array<int, 4> tet = open.back();
    open.pop_back();
    const std::optional<VertexEdge> edge = first_divided(tet, vertex_on);
    if (!edge) {
      result.tets.push_back(tet);
      continue;
    }
    const int middle = vertex_on.at(*edge);
    std::array<int, 4> with_first = tet, with_second = tet;
    std::ranges::replace(with_first, edge->second, middle);
    std::ranges::replace(with_second, edge->first, middle);
    open.push_back(with_second);
    open.push_back(with_first);
  }
  return result;
}

}  // namespace thinwall::mesh

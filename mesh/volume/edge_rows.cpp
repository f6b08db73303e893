#include "mesh/volume/edge_rows.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "mesh/solid/edge_division.hpp"
#include "mesh/surface/edge_uses.hpp"
#include "mesh/surface/surface_distance.hpp"
#include "mesh/surface/wall_thickness.hpp"

namespace thinwall::mesh {

namespace {

constexpr double reach = 1.1;  // wall thicknesses, within which a vertex belongs to a sharp edge: across the wall, too
constexpr double longest = 3.0;  // likewise, beyond which an edge that leads away from a sharp edge is divided

/// A sharp edge of the boundary.
struct SharpEdge {
  Eigen::Vector3d from, to;
  double wall = 0.0;  ///< thickness of the thinner wall beside it, m
  bool reentrant = false;
};

std::vector<SharpEdge> sharp_edges(const TriangleSurface& surface, double sharp_angle_rad) {
  const std::vector<double> wall = wall_thickness(surface, TriangleTree(surface));
  std::vector<SharpEdge> result;
  for_each_edge(sorted_edges(surface.triangles), [&](std::span<const EdgeUse> both) {
    if (both.size() != 2) return;
    const int left = both[both[0].is_forward ? 0 : 1].triangle, right = both[both[0].is_forward ? 1 : 0].triangle;
    const Eigen::Vector3d a = area_vector(surface, left).normalized(), b = area_vector(surface, right).normalized();
    if (a.dot(b) > std::cos(sharp_angle_rad)) return;
    const Eigen::Vector3d& from = surface.vertices[static_cast<std::size_t>(both[0].ends[0])];
    const Eigen::Vector3d& to = surface.vertices[static_cast<std::size_t>(both[0].ends[1])];
    // An edge across a wall, between two of its rims, is as long as the wall is thick.
    const double thinner = std::min(wall[static_cast<std::size_t>(left)], wall[static_cast<std::size_t>(right)]);
    result.push_back({from, to, std::min(thinner, (to - from).norm()), a.cross(b).dot(to - from) < 0.0});
  });
  return result;
}

double distance_from(const SharpEdge& edge, const Eigen::Vector3d& x) {
  const Eigen::Vector3d along = edge.to - edge.from;
  const double s = std::clamp((x - edge.from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (x - edge.from - s * along).norm();
}

/// The sharp edges to which each vertex belongs.
std::vector<std::vector<SharpEdge>> edges_at_vertices(const TetMesh& mesh, const std::vector<SharpEdge>& sharp) {
  std::vector<std::vector<SharpEdge>> result(mesh.vertices.size());
  for (std::size_t v = 0; v < result.size(); ++v)
    for (const SharpEdge& edge : sharp)
      if (distance_from(edge, mesh.vertices[v]) <= reach * edge.wall) result[v].push_back(edge);
  return result;
}

/// The place at which an edge is to be divided beside the sharp edges at its start.
struct RowEnd {
  double share = 0.0;  ///< of the edge's length, from its start
  bool reentrant = false;
};

/// The place at which an edge that leads along `way` (m) from some sharp edges leaves the widest of their rows; none if
/// it leads away from none of them.
std::optional<RowEnd> row_end_beside(const std::vector<SharpEdge>& sharp, const Eigen::Vector3d& way) {
  std::optional<RowEnd> result;
  for (const SharpEdge& edge : sharp) {
    const Eigen::Vector3d along = (edge.to - edge.from).normalized();
    const double across = (way - along * along.dot(way)).norm();
    if (across < longest * edge.wall) continue;
    if (!result) result.emplace();
    result->share = std::max(result->share, width_of_rows * edge.wall / across);
    result->reentrant = result->reentrant || edge.reentrant;
  }
  return result;
}

/// The share of an edge's length, from its start, at which it is divided; none if it stays whole.
std::optional<double> division(const std::optional<RowEnd>& from_start, const std::optional<RowEnd>& from_end) {
  if (from_start && (!from_end || (from_start->reentrant && !from_end->reentrant))) return from_start->share;
  if (from_end && (!from_start || (from_end->reentrant && !from_start->reentrant))) return 1.0 - from_end->share;
  return {};
}

}  // namespace

EdgeRows with_rows_at_edges(const TetMesh& mesh, double sharp_angle_rad) {
  const auto sharp_at = edges_at_vertices(mesh, sharp_edges(boundary_surface(mesh), sharp_angle_rad));
  std::map<VertexEdge, Eigen::Vector3d> points;
  std::set<VertexEdge> whole;
  for (const auto& tet : mesh.tets) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        if (tet[i] >= tet[j]) continue;
        const auto a = static_cast<std::size_t>(tet[i]), b = static_cast<std::size_t>(tet[j]);
        const Eigen::Vector3d way = mesh.vertices[b] - mesh.vertices[a];
        const auto from_start = row_end_beside(sharp_at[a], way), from_end = row_end_beside(sharp_at[b], -way);
        const auto share = division(from_start, from_end);
        if (share) points.emplace(VertexEdge{tet[i], tet[j]}, mesh.vertices[a] + *share * way);
        if (!share && from_start) whole.emplace(tet[i], tet[j]);
      }
    }
  }
  return {divided_at(mesh, points), points.size(), whole.size()};
}

}  // namespace thinwall::mesh

#include "mesh/volume/beneath_curves.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace thinwall::mesh {

namespace {

constexpr double cosine_of_flat = 0.8660254037844386;  // 30°
constexpr int rounds = 3;                              // of taking flat tetrahedra away: one may lie beneath another

using VertexPair = std::array<int, 2>;

VertexPair pair_of(int a, int b) {
  return {std::min(a, b), std::max(a, b)};
}

Eigen::Vector3d normal_of_face(const TetMesh& mesh, const BoundaryTriangle& face) {
  const auto at = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(face.vertices[k])]; };
  return (at(1) - at(0)).cross(at(2) - at(0)).normalized();
}

/// The faces of the boundary of each tetrahedron that has two or more of them on one curved patch.
using Doubled = std::map<int, std::vector<BoundaryTriangle>>;

Doubled doubled(const SmoothPatches& surface, const TetMesh& mesh, const std::vector<BoundaryTriangle>& faces) {
  Doubled all;
  for (const BoundaryTriangle& face : faces) all[face.tet].push_back(face);
  std::erase_if(all, [&](const auto& entry) {
    std::vector<int> patches;
    if (entry.second.size() < 2) return true;
    for (const BoundaryTriangle& face : entry.second) {
      const int patch = patch_beneath(surface, mesh, face);
      if (patch >= 0 && !surface.patches[static_cast<std::size_t>(patch)].planar) patches.push_back(patch);
    }
    std::ranges::sort(patches);
    return std::ranges::adjacent_find(patches) == patches.end();
  });
  return all;
}

/// The edge that two faces of a tetrahedron have in common, and the edge opposite.
std::pair<VertexPair, VertexPair> edges_between(const BoundaryTriangle& first, const BoundaryTriangle& second) {
  std::vector<int> common, single;
  for (const int v : first.vertices)
    (std::ranges::find(second.vertices, v) != second.vertices.end() ? common : single).push_back(v);
  for (const int v : second.vertices)
    if (std::ranges::find(first.vertices, v) == first.vertices.end()) single.push_back(v);
  return {pair_of(common[0], common[1]), pair_of(single[0], single[1])};
}

/// Takes flat tetrahedra away that have two faces on one curved patch and no vertex in common with another such one;
/// returns their number.
int peel_flat(const SmoothPatches& surface, TetMesh& mesh) {
  const auto faces = boundary(mesh);
  std::set<VertexPair> edges;
  for (const BoundaryTriangle& face : faces)
    for (std::size_t k = 0; k < 3; ++k) edges.insert(pair_of(face.vertices[k], face.vertices[(k + 1) % 3]));
  std::set<int> taken, touched;
  for (const auto& [tet, own] : doubled(surface, mesh, faces)) {
    if (own.size() != 2 || normal_of_face(mesh, own[0]).dot(normal_of_face(mesh, own[1])) < cosine_of_flat) continue;
    const auto& vertices = mesh.tets[static_cast<std::size_t>(tet)];
    if (edges.contains(edges_between(own[0], own[1]).second)) continue;
    if (std::ranges::any_of(vertices, [&](int v) { return touched.contains(v); })) continue;
    taken.insert(tet);
    touched.insert(vertices.begin(), vertices.end());
  }
  std::vector<std::array<int, 4>> left;
  for (std::size_t tet = 0; tet < mesh.tets.size(); ++tet)
    if (!taken.contains(static_cast<int>(tet))) left.push_back(mesh.tets[tet]);
  mesh.tets = std::move(left);
  return static_cast<int>(taken.size());
}

/// Divides a tetrahedron into four at its centroid.
void divide_at_centroid(TetMesh& mesh, int tet) {
  const std::array<int, 4> whole = mesh.tets[static_cast<std::size_t>(tet)];
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const int v : whole) centre += mesh.vertices[static_cast<std::size_t>(v)] / 4.0;
  const int vertex = static_cast<int>(mesh.vertices.size());
  mesh.vertices.push_back(centre);
  mesh.tets[static_cast<std::size_t>(tet)][0] = vertex;
  for (std::size_t k = 1; k < 4; ++k) {
    mesh.tets.push_back(whole);
    mesh.tets.back()[k] = vertex;
  }
}

}  // namespace

TetMesh fitted_beneath_curves(const SmoothPatches& surface, TetMesh mesh) {
  for (int round = 0; round < rounds && peel_flat(surface, mesh) > 0; ++round) {
  }
  for (const auto& [tet, faces] : doubled(surface, mesh, boundary(mesh))) divide_at_centroid(mesh, tet);
  return mesh;
}

}  // namespace thinwall::mesh

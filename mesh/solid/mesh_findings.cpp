#include "mesh/solid/mesh_findings.hpp"

#include <algorithm>
#include <map>

#include "mesh/pieces.hpp"
#include "mesh/triangle_soup.hpp"

namespace thinwall::mesh {

namespace {

std::string centre_text(const SolidMesh& solid, std::size_t tet) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const int vertex : solid.mesh.tets[tet]) centre += 0.25 * solid.mesh.vertices[static_cast<std::size_t>(vertex)];
  return place_text(centre);
}

/// The first tetrahedron of each piece and its number of tetrahedra.
using Pieces = std::map<int, std::pair<std::size_t, int>>;

Pieces counted(const std::vector<int>& piece_of_tet) {
  Pieces result;
  for (std::size_t tet = 0; tet < piece_of_tet.size(); ++tet)
    ++result.try_emplace(piece_of_tet[tet], tet, 0).first->second.second;
  return result;
}

std::vector<int> pieces_by_nodes(const SolidMesh& solid) {
  const std::vector<int> of_vertex = pieces(static_cast<int>(solid.mesh.vertices.size()), solid.mesh.tets);
  std::vector<int> of_tet;
  for (const auto& tet : solid.mesh.tets) of_tet.push_back(of_vertex[static_cast<std::size_t>(tet[0])]);
  return of_tet;
}

std::vector<int> pieces_by_faces(const SolidMesh& solid) {
  struct Face {
    std::array<int, 3> corners;
    int tet;
  };
  std::vector<Face> faces;
  faces.reserve(4 * solid.mesh.tets.size());
  for (std::size_t tet = 0; tet < solid.mesh.tets.size(); ++tet) {
    std::array<int, 4> t = solid.mesh.tets[tet];
    std::sort(t.begin(), t.end());
    const int own = static_cast<int>(tet);
    faces.insert(
        faces.end(),
        {{{t[1], t[2], t[3]}, own}, {{t[0], t[2], t[3]}, own}, {{t[0], t[1], t[3]}, own}, {{t[0], t[1], t[2]}, own}});
  }
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.corners < b.corners; });
  std::vector<std::array<int, 2>> neighbours;
  for (std::size_t i = 1; i < faces.size(); ++i)
    if (faces[i].corners == faces[i - 1].corners) neighbours.push_back({faces[i - 1].tet, faces[i].tet});
  return pieces(static_cast<int>(solid.mesh.tets.size()), neighbours);
}

std::string pieces_text(const SolidMesh& solid, const Pieces& all) {
  constexpr std::size_t shown = 4;
  std::string text = "the mesh is in " + std::to_string(all.size()) + " pieces that share no node:";
  std::size_t count = 0;
  for (const auto& [piece, first_and_size] : all) {
    if (count++ == shown) return text + " ...";
    text += (count > 1 ? ", " : " ") + std::to_string(first_and_size.second) + " tetrahedra at " +
            centre_text(solid, first_and_size.first);
  }
  return text;
}

/// The boundary corners with those at one position merged.
MergedPoints coincident(const SolidMesh& solid) {
  TriangleSoup outside{solid.mesh.vertices, {}};
  for (const BoundaryTriangle& triangle : boundary(solid.mesh)) outside.triangles.push_back(triangle.vertices);
  const SoupBounds box = bounds(outside);
  const double diagonal = (box.largest - box.least).norm();
  const double far = box.largest.cwiseAbs().cwiseMax(box.least.cwiseAbs()).maxCoeff();
  return merged_points(outside, far < 1e6 * diagonal ? 1e-9 * diagonal : 0.0);
}

}  // namespace

MeshFindings mesh_findings(const SolidMesh& solid) {
  MeshFindings findings;
  const Pieces by_nodes = counted(pieces_by_nodes(solid));
  const Pieces by_faces = counted(pieces_by_faces(solid));
  findings.pieces = static_cast<int>(by_nodes.size());
  if (by_nodes.size() > 1) findings.notices.push_back(pieces_text(solid, by_nodes));
  if (by_faces.size() > by_nodes.size()) {
    const auto smaller = [](const auto& a, const auto& b) { return a.second.second < b.second.second; };
    const auto smallest = std::min_element(by_faces.begin(), by_faces.end(), smaller);
    findings.notices.push_back(std::to_string(by_faces.size() - by_nodes.size()) +
                               " parts of the mesh hang on the rest by an edge or a node only; the smallest, " +
                               std::to_string(smallest->second.second) + " tetrahedra with element " +
                               std::to_string(solid.element_labels[smallest->second.first]) + ", at " +
                               centre_text(solid, smallest->second.first));
  }
  const MergedPoints points = coincident(solid);
  findings.coincident_nodes = points.merged;
  if (points.merged > 0) {
    findings.notices.push_back(std::to_string(points.merged) +
                               " nodes lie where another one lies and are not shared, the first at " +
                               place_text(points.first_merged) + ": a crack, unless it is wanted; merge them");
  }
  return findings;
}

}  // namespace thinwall::mesh

#include "setup/loose_pieces.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "core/error.hpp"
#include "mesh/pieces.hpp"
#include "mesh/selection.hpp"
#include "setup/imported_part.hpp"
#include "setup/part_geometry.hpp"

namespace thinwall::setup {

namespace {

/// The piece of every node, as the lowest vertex number in it.
std::vector<int> piece_of_nodes(const mesh::SolidMesh& solid) {
  const auto of_vertex = mesh::pieces(static_cast<int>(solid.mesh.vertices.size()), solid.mesh.tets);
  std::vector<int> of_node(static_cast<std::size_t>(solid.nodes.positions.rows()), -1);
  for (Eigen::Index e = 0; e < solid.nodes.elements.rows(); ++e) {
    const int piece = of_vertex[static_cast<std::size_t>(solid.mesh.tets[static_cast<std::size_t>(e)][0])];
    for (const int node : solid.nodes.elements.row(e)) of_node[static_cast<std::size_t>(node)] = piece;
  }
  return of_node;
}

/// The node nearest to a place.
int nearest_node(const mesh::SolidMesh& solid, const Eigen::Vector3d& x) {
  Eigen::Index nearest = 0;
  (solid.nodes.positions.rowwise() - x.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
  return static_cast<int>(nearest);
}

/// The nodes by which a face, a selection or a set of nodes holds the mesh; none of a name that meets no face or that
/// nothing has, which is told elsewhere.
std::vector<int> nodes_of(const PartSetup& source, const mesh::SolidMesh& solid, const std::string& name) {
  try {
    if (names_node_set(source, name)) return mesh::node_set(solid, name, main_file(*source.part).string()).nodes;
    return mesh::nodes_on(solid.nodes, solid.mesh,
                          mesh::select(solid.mesh, mesh::boundary(solid.mesh), region_of(source, name), name));
  } catch (const core::Error&) {
    return {};
  }
}

/// One node or more of each piece that is held.
std::vector<int> held_nodes(const PartSetup& source, const mesh::SolidMesh& solid) {
  std::vector<int> held;
  const auto add = [&held](const std::vector<int>& nodes) { held.insert(held.end(), nodes.begin(), nodes.end()); };
  for (const Support& support : source.part->supports) add(nodes_of(source, solid, support.on));
  for (const Clamp& clamp : source.part->clamps) add(nodes_of(source, solid, clamp.on));
  for (const PointSpring& spring : source.part->springs) {
    const auto point = std::ranges::find(source.points, spring.at, &Point::name);
    if (point != source.points.end()) held.push_back(nearest_node(solid, position(*source.part, *point)));
  }
  return held;
}

}  // namespace

std::vector<MeshPiece> loose_pieces(const PartSetup& source) {
  const mesh::SolidMesh* solid = source.part ? solid_of(*source.part) : nullptr;
  if (solid == nullptr || solid->pieces < 2) return {};
  const std::vector<int> piece_of_node = piece_of_nodes(*solid);
  std::set<int> held;
  for (const int node : held_nodes(source, *solid)) held.insert(piece_of_node[static_cast<std::size_t>(node)]);
  if (held.empty()) return {};
  std::map<int, MeshPiece> loose;
  for (std::size_t tet = 0; tet < solid->mesh.tets.size(); ++tet) {
    const auto& corners = solid->mesh.tets[tet];
    const int piece = piece_of_node[static_cast<std::size_t>(solid->nodes.elements(static_cast<Eigen::Index>(tet), 0))];
    if (held.contains(piece)) continue;
    MeshPiece& found = loose[piece];
    if (found.tets++ > 0) continue;
    for (const int corner : corners) found.place += 0.25 * solid->mesh.vertices[static_cast<std::size_t>(corner)];
  }
  std::vector<MeshPiece> list;
  list.reserve(loose.size());
  for (const auto& [piece, found] : loose) list.push_back(found);
  return list;
}

}  // namespace thinwall::setup

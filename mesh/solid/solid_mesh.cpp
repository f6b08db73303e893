#include "mesh/solid/solid_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "core/nearest_name.hpp"
#include "core/units.hpp"
#include "mesh/solid/cell_split.hpp"
#include "mesh/solid/joined_sets.hpp"
#include "mesh/solid/labelled_checks.hpp"
#include "mesh/solid/mesh_findings.hpp"
#include "mesh/solid/midside_order.hpp"
#include "mesh/solid/tet_jacobian.hpp"
#include "mesh/triangle_soup.hpp"

namespace thinwall::mesh {

namespace {

/// Least det J over its mean that is accepted in an element.
constexpr double jacobian_bound = 1e-3;

/// For each edge of the tetrahedron in the order of cell_shape.hpp the node of mesh::lattice(2) in its middle.
std::array<Eigen::Index, 6> lattice_middles() {
  const auto nodes = lattice(2);
  std::array<Eigen::Index, 6> result{};
  const auto& edges = topology(CellShape::tetrahedron).edges;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    std::array<int, 4> alpha{};
    alpha[edges[e][0]] = alpha[edges[e][1]] = 1;
    result[e] = std::find(nodes.begin(), nodes.end(), alpha) - nodes.begin();
  }
  return result;
}

/// The final index of each of the file's nodes, −1 for those left out: corners first, each kind by rising label.
std::vector<int> place_nodes(const LabelledMesh& labelled, const std::vector<int>& rows, SolidMesh& solid) {
  const std::vector<NodeRole> role = node_roles(labelled, rows);
  std::vector<int> place(labelled.nodes.size(), -1);
  for (const NodeRole kind : {NodeRole::corner, NodeRole::middle}) {
    for (std::size_t row = 0; row < place.size(); ++row) {
      if (role[row] != kind) continue;
      place[row] = static_cast<int>(solid.node_labels.size());
      solid.node_labels.push_back(labelled.nodes[row].label);
      if (kind == NodeRole::corner) solid.mesh.vertices.push_back(labelled.nodes[row].x);
    }
  }
  solid.nodes.positions.resize(static_cast<Eigen::Index>(solid.node_labels.size()), 3);
  for (std::size_t row = 0; row < place.size(); ++row)
    if (place[row] >= 0) solid.nodes.positions.row(place[row]) = labelled.nodes[row].x.transpose();
  const std::size_t unused = place.size() - solid.node_labels.size();
  if (unused > 0) solid.notices.push_back(std::to_string(unused) + " nodes that no solid element uses are left out");
  return place;
}

void place_tets(const LabelledMesh& labelled, const SplitCells& split, SolidMesh& solid) {
  const Eigen::Index given = solid.nodes.positions.rows();
  solid.nodes.positions.conservativeResize(given + static_cast<Eigen::Index>(split.made.size()), 3);
  for (std::size_t m = 0; m < split.made.size(); ++m)
    solid.nodes.positions.row(given + static_cast<Eigen::Index>(m)) = split.made[m].x.transpose();
  solid.node_labels.resize(solid.node_labels.size() + split.made.size(), -1);
  solid.mesh.tets = split.tets;
  solid.nodes.order = split.middles.empty() ? 1 : 2;
  const auto middle = lattice_middles();
  solid.nodes.elements.resize(static_cast<Eigen::Index>(split.tets.size()), solid.nodes.order == 1 ? 4 : 10);
  for (std::size_t tet = 0; tet < split.tets.size(); ++tet) {
    const auto row = static_cast<Eigen::Index>(tet);
    for (std::size_t k = 0; k < 4; ++k) solid.nodes.elements(row, static_cast<Eigen::Index>(k)) = split.tets[tet][k];
    for (std::size_t e = 0; e < 6 && solid.nodes.order == 2; ++e)
      solid.nodes.elements(row, middle[e]) = split.middles[tet][e];
    solid.element_labels.push_back(labelled.cells[split.cell_of_tet[tet]].label);
  }
}

[[noreturn]] void fail_jacobian(const LabelledMesh& labelled, const LabelledCell& cell, const LeastJacobian& least) {
  const std::string element = "element " + std::to_string(cell.label);
  const std::string where = place_text(least.at) + ", det J is " + core::number_text(least.ratio);
  if (!least.has_volume) {
    const bool is_part = cell.shape != CellShape::tetrahedron;
    fail_at(labelled, cell.line,
            element + (is_part ? " has a corner without positive volume at " : " has no positive volume at ") + where +
                " of its longest edge cubed: its corners lie in one plane, or are numbered in the wrong sense");
  }
  fail_at(labelled, cell.line,
          element + " is turned inside out at " + where +
              " of its mean there: its mid-edge nodes bend it too far; mesh finer there, or with straight edges");
}

void require_sound_jacobians(const LabelledMesh& labelled, const SplitCells& split, SolidMesh& solid) {
  for (Eigen::Index tet = 0; tet < solid.nodes.elements.rows(); ++tet) {
    const LeastJacobian least = least_jacobian(solid.nodes, tet, jacobian_bound);
    solid.least_jacobian = std::min(solid.least_jacobian, least.ratio);
    if (!least.is_sound)
      fail_jacobian(labelled, labelled.cells[split.cell_of_tet[static_cast<std::size_t>(tet)]], least);
  }
}

/// The sets, with those of equal name joined at the place of the first.
std::vector<LabelledSet> joined_by_name(std::vector<LabelledSet> sets) {
  std::vector<LabelledSet> joined;
  std::map<std::string, std::size_t> place;
  for (LabelledSet& set : sets) {
    const auto [known, is_new] = place.emplace(set.name, joined.size());
    if (is_new) {
      joined.push_back(std::move(set));
    } else {
      std::vector<std::int64_t>& labels = joined[known->second].labels;
      labels.insert(labels.end(), set.labels.begin(), set.labels.end());
      if (joined[known->second].fault.empty()) joined[known->second].fault = std::move(set.fault);
    }
  }
  return joined;
}

std::vector<NodeSet> placed_node_sets(const LabelledMesh& labelled, const std::vector<int>& place,
                                      const std::vector<MadeNode>& made, int first_made) {
  std::vector<NodeSet> sets;
  for (const LabelledSet& set : labelled.node_sets) {
    NodeSet& placed = sets.emplace_back();
    placed.name = set.name;
    placed.fault = set.fault;
    for (const std::int64_t label : set.labels) {
      const int node = place[static_cast<std::size_t>(row_of_node(labelled, label, 0))];
      if (node >= 0) placed.nodes.push_back(node);
    }
    std::sort(placed.nodes.begin(), placed.nodes.end());
    placed.nodes.erase(std::unique(placed.nodes.begin(), placed.nodes.end()), placed.nodes.end());
  }
  std::vector<NodesWithin> groups;
  for (const MadeNode& node : made) {
    NodesWithin& group = groups.emplace_back();
    std::copy_if(node.corners.begin(), node.corners.end(), std::back_inserter(group.corners),
                 [](int corner) { return corner >= 0; });
    group.nodes = {first_made++};
  }
  join_sets(sets, groups);
  return sets;
}

std::vector<ElementSet> placed_element_sets(const LabelledMesh& labelled, const SolidMesh& solid) {
  std::vector<std::pair<std::int64_t, int>> tets;  // label, tetrahedron
  for (std::size_t tet = 0; tet < solid.element_labels.size(); ++tet)
    tets.emplace_back(solid.element_labels[tet], static_cast<int>(tet));
  std::sort(tets.begin(), tets.end());
  std::vector<ElementSet> sets;
  for (const LabelledSet& set : labelled.cell_sets) {
    ElementSet& placed = sets.emplace_back();
    placed.name = set.name;
    for (const std::int64_t label : set.labels) {
      auto tet = std::lower_bound(tets.begin(), tets.end(), std::pair<std::int64_t, int>{label, 0});
      for (; tet != tets.end() && tet->first == label; ++tet) placed.tets.push_back(tet->second);
    }
    std::sort(placed.tets.begin(), placed.tets.end());
    placed.tets.erase(std::unique(placed.tets.begin(), placed.tets.end()), placed.tets.end());
  }
  return sets;
}

double midside_offset(const LagrangeNodes& nodes) {
  if (nodes.order == 1) return 0.0;
  double worst = 0.0;
  const auto middle = lattice_middles();
  const auto& edges = topology(CellShape::tetrahedron).edges;
  for (Eigen::Index tet = 0; tet < nodes.elements.rows(); ++tet) {
    const auto position = [&](Eigen::Index local) { return nodes.positions.row(nodes.elements(tet, local)); };
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const Eigen::RowVector3d a = position(static_cast<Eigen::Index>(edges[e][0]));
      const Eigen::RowVector3d b = position(static_cast<Eigen::Index>(edges[e][1]));
      worst = std::max(worst, (position(middle[e]) - 0.5 * (a + b)).squaredNorm() / (b - a).squaredNorm());
    }
  }
  return std::sqrt(worst);
}

/// A line such as "20 hexahedra and 4 wedges of order 2 are 132 tetrahedra here".
std::string kinds_text(const LabelledMesh& labelled, const SolidMesh& solid) {
  std::array<int, 4> count{};
  for (const LabelledCell& cell : labelled.cells) ++count[static_cast<std::size_t>(cell.shape)];
  std::string text;
  for (std::size_t k = 0; k < count.size(); ++k) {
    if (count[k] == 0) continue;
    const CellTopology& shape = topology(static_cast<CellShape>(k));
    text +=
        (text.empty() ? "" : " and ") + std::to_string(count[k]) + " " + (count[k] == 1 ? shape.name : shape.plural);
  }
  text += " of order " + std::to_string(solid.nodes.order);
  if (count[0] == static_cast<int>(labelled.cells.size())) return text;
  return text + ", split into " + std::to_string(solid.mesh.tets.size()) + " tetrahedra";
}

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

template <class Set>
const Set& named(const std::vector<Set>& sets, const char* kind, const std::string& name, const std::string& path) {
  std::vector<std::string> names;
  for (const Set& set : sets) {
    if (set.name == name) return set;
    names.push_back(lower(set.name));
  }
  const auto same = std::find(names.begin(), names.end(), lower(name));
  if (same != names.end()) return sets[static_cast<std::size_t>(same - names.begin())];
  const auto nearest = std::find(names.begin(), names.end(), core::nearest_name(lower(name), names));
  const std::string offer =
      nearest == names.end()
          ? ""
          : " (did you mean \"" + sets[static_cast<std::size_t>(nearest - names.begin())].name + "\"?)";
  throw core::DataError(path + ": holds no " + kind + " set \"" + name + "\"" + offer);
}

}  // namespace

SolidMesh solid_mesh(LabelledMesh labelled) {
  SolidMesh solid;
  solid.notices = std::move(labelled.notices);
  labelled.node_sets = joined_by_name(std::move(labelled.node_sets));
  labelled.cell_sets = joined_by_name(std::move(labelled.cell_sets));
  std::vector<int> rows = checked_rows(labelled, solid.notices);
  if (put_middles_right(labelled, rows)) {
    solid.notices.emplace_back(
        "the last two nodes of every ten-node tetrahedron are exchanged in the file (the order of another program); "
        "put "
        "right");
  }
  const std::vector<int> place = place_nodes(labelled, rows, solid);
  for (int& row : rows) row = place[static_cast<std::size_t>(row)];
  const int first_made = static_cast<int>(solid.node_labels.size());
  const SplitCells split = split_cells(labelled, rows, solid.nodes.positions);
  place_tets(labelled, split, solid);
  require_sound_jacobians(labelled, split, solid);
  solid.node_sets = placed_node_sets(labelled, place, split.made, first_made);
  solid.element_sets = placed_element_sets(labelled, solid);
  solid.midside_offset = midside_offset(solid.nodes);
  solid.notices.insert(solid.notices.begin(), kinds_text(labelled, solid));
  const MeshFindings findings = mesh_findings(solid);
  solid.pieces = findings.pieces;
  solid.coincident_nodes = findings.coincident_nodes;
  solid.notices.insert(solid.notices.end(), findings.notices.begin(), findings.notices.end());
  return solid;
}

SolidMesh with_order(SolidMesh solid, int order) {
  if (order == solid.nodes.order) return solid;
  if (order != 2) {
    throw core::InputError("a mesh of order " + std::to_string(solid.nodes.order) +
                           " can be raised to order 2, not brought to " + std::to_string(order));
  }
  solid.nodes = lagrange_nodes(solid.mesh, 2);
  solid.node_labels.resize(static_cast<std::size_t>(solid.nodes.positions.rows()), -1);
  std::vector<NodesWithin> groups;
  const auto local = lattice(2);
  const auto middles_within = [&](std::size_t tet, const std::vector<int>& corners) {
    NodesWithin group{corners, {}};
    for (std::size_t a = 4; a < local.size(); ++a) {
      bool inside = true;
      for (std::size_t k = 0; k < 4; ++k)
        inside = inside && (local[a][k] == 0 ||
                            std::find(corners.begin(), corners.end(), solid.mesh.tets[tet][k]) != corners.end());
      if (inside) group.nodes.push_back(solid.nodes.elements(static_cast<Eigen::Index>(tet), static_cast<int>(a)));
    }
    return group;
  };
  for (const BoundaryTriangle& face : boundary(solid.mesh))
    groups.push_back(middles_within(static_cast<std::size_t>(face.tet), {face.vertices.begin(), face.vertices.end()}));
  for (std::size_t tet = 0; tet < solid.mesh.tets.size(); ++tet)
    groups.push_back(middles_within(tet, {solid.mesh.tets[tet].begin(), solid.mesh.tets[tet].end()}));
  join_sets(solid.node_sets, groups);
  return solid;
}

const NodeSet& node_set(const SolidMesh& solid, const std::string& name, const std::string& path) {
  const NodeSet& set = named(solid.node_sets, "node", name, path);
  if (!set.fault.empty()) throw core::DataError(set.fault);
  return set;
}

const ElementSet& element_set(const SolidMesh& solid, const std::string& name, const std::string& path) {
  return named(solid.element_sets, "element", name, path);
}

}  // namespace thinwall::mesh

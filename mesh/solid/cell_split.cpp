#include "mesh/solid/cell_split.hpp"

#include <algorithm>
#include <cstdint>
#include <set>
#include <unordered_map>

#include "mesh/tet_mesh.hpp"

namespace thinwall::mesh {

namespace {

using CellPositions = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Local = std::vector<std::array<std::size_t, 4>>;  ///< tetrahedra by local corners

/// A key of the edge between two nodes, the same in both directions.
std::uint64_t edge_key(int a, int b) {
  const auto [low, high] = std::minmax(a, b);
  return (static_cast<std::uint64_t>(low) << 32U) | static_cast<std::uint64_t>(static_cast<std::uint32_t>(high));
}

/// The local corner of a face whose node has the lowest number.
std::size_t lowest_corner(const std::vector<std::size_t>& face, const int* nodes) {
  const auto lower = [nodes](std::size_t a, std::size_t b) { return nodes[a] < nodes[b]; };
  return static_cast<std::size_t>(std::min_element(face.begin(), face.end(), lower) - face.begin());
}

/// True if the tetrahedron's corners are four different nodes.
bool are_different(const std::array<std::size_t, 4>& tet, const int* nodes) {
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j)
      if (nodes[tet[i]] == nodes[tet[j]]) return false;
  return true;
}

/// The tetrahedra of a cell: cones from its lowest corner over the faces without it, each face divided into a fan from
/// its own lowest corner.
Local local_tets(const CellTopology& cell, const int* nodes) {
  Local tets;
  if (cell.corners == 4) {
    tets.push_back({0, 1, 2, 3});
    return tets;
  }
  const auto apex = static_cast<std::size_t>(std::min_element(nodes, nodes + cell.corners) - nodes);
  for (const auto& face : cell.faces) {
    if (std::find(face.begin(), face.end(), apex) != face.end()) continue;
    const std::size_t start = lowest_corner(face, nodes);
    for (std::size_t k = 1; k + 1 < face.size(); ++k) {
      const std::array<std::size_t, 4> tet{face[start], face[(start + k + 1) % face.size()],
                                           face[(start + k) % face.size()], apex};
      if (are_different(tet, nodes)) tets.push_back(tet);
    }
  }
  return tets;
}

/// The division of all cells of a mesh, with the middles of edges and diagonals that neighbours share.
class Splitter {
 public:
  Splitter(const LabelledMesh& labelled, const std::vector<int>& nodes, const CellPositions& positions)
      : labelled_(labelled), nodes_(nodes), positions_(positions) {}

  SplitCells split() {
    const LabelledCell& first = labelled_.cells.front();
    order_ = cell_order(first.shape, first.nodes);
    if (order_ == 2) {
      middle_of_edge_.reserve(2 * labelled_.cells.size());
      for (const LabelledCell& cell : labelled_.cells) note_edges(cell);
    }
    for (std::size_t c = 0; c < labelled_.cells.size(); ++c) split_cell(c);
    return std::move(result_);
  }

 private:
  const int* nodes_of(const LabelledCell& cell) const { return nodes_.data() + cell.first; }

  /// Notes the middles of the cell's edges; throws DataError if another cell has a different node there.
  void note_edges(const LabelledCell& cell) {
    const CellTopology& shape = topology(cell.shape);
    const int* nodes = nodes_of(cell);
    for (std::size_t e = 0; e < shape.edges.size(); ++e) {
      const auto [a, b] = shape.edges[e];
      if (nodes[a] == nodes[b]) continue;
      const int middle = nodes[shape.corners + e];
      const auto [known, is_new] = middle_of_edge_.try_emplace(edge_key(nodes[a], nodes[b]), middle);
      if (is_new || known->second == middle) continue;
      fail_at(labelled_, cell.line,
              "element " + std::to_string(cell.label) + " has another node in the middle of the edge between nodes " +
                  label_of(cell, a) + " and " + label_of(cell, b) +
                  " than the element beside it: the elements do not fit together; merge the nodes");
    }
  }

  [[nodiscard]] std::string label_of(const LabelledCell& cell, std::size_t local) const {
    return std::to_string(labelled_.cell_nodes[cell.first + local]);
  }

  void split_cell(std::size_t index) {
    const LabelledCell& cell = labelled_.cells[index];
    const int* nodes = nodes_of(cell);
    const Local tets = local_tets(topology(cell.shape), nodes);
    if (tets.empty())
      fail_at(labelled_, cell.line,
              "element " + std::to_string(cell.label) + " has no volume: too many of its corners are one node");
    for (const auto& tet : tets) {
      auto& corners = result_.tets.emplace_back();
      for (std::size_t k = 0; k < 4; ++k) corners[k] = nodes[tet[k]];
      result_.cell_of_tet.push_back(index);
      if (order_ == 2) add_middles(cell, tet);
    }
  }

  /// Appends the middles of a tetrahedron's edges, which are edges or diagonals of the cell.
  void add_middles(const LabelledCell& cell, const std::array<std::size_t, 4>& tet) {
    const auto& edges = topology(CellShape::tetrahedron).edges;
    auto& middles = result_.middles.emplace_back();
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const std::size_t a = tet[edges[e][0]];
      const std::size_t b = tet[edges[e][1]];
      const std::uint64_t key = edge_key(nodes_of(cell)[a], nodes_of(cell)[b]);
      const auto known = middle_of_edge_.find(key);
      middles[e] = known != middle_of_edge_.end() ? known->second : diagonal_middle(cell, a, b);
      if (known == middle_of_edge_.end()) middle_of_edge_.emplace(key, middles[e]);
    }
  }

  /// The middle of the diagonal between the corners a and b, in a face or inside the cell: the file's node if there is
  /// one, or a new node.
  int diagonal_middle(const LabelledCell& cell, std::size_t a, std::size_t b) {
    const CellTopology& shape = topology(cell.shape);
    const bool has_face_nodes = cell.nodes > shape.corners + shape.edges.size();
    std::size_t own = shape.corners + shape.edges.size();
    for (const auto& face : shape.faces) {
      if (face.size() != 4) continue;
      const bool has_both =
          std::find(face.begin(), face.end(), a) != face.end() && std::find(face.begin(), face.end(), b) != face.end();
      if (has_both) return has_face_nodes ? nodes_of(cell)[own] : made_node(cell, face, 0.5);
      ++own;
    }
    if (has_face_nodes) return nodes_of(cell)[own];
    std::vector<std::size_t> all(shape.corners);
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = k;
    return made_node(cell, all, 0.25);
  }

  /// A new node at x = −¼ Σ corners + weight Σ middles of the edges between them.
  int made_node(const LabelledCell& cell, const std::vector<std::size_t>& corners, double weight) {
    const CellTopology& shape = topology(cell.shape);
    const int* nodes = nodes_of(cell);
    MadeNode made;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      made.corners[k] = nodes[corners[k]];
      made.x -= 0.25 * positions_.row(nodes[corners[k]]).transpose();
    }
    const auto is_in = [&corners](std::size_t c) {
      return std::find(corners.begin(), corners.end(), c) != corners.end();
    };
    for (std::size_t e = 0; e < shape.edges.size(); ++e)
      if (is_in(shape.edges[e][0]) && is_in(shape.edges[e][1]))
        made.x += weight * positions_.row(nodes[shape.corners + e]).transpose();
    result_.made.push_back(made);
    return static_cast<int>(positions_.rows()) + static_cast<int>(result_.made.size()) - 1;
  }

  const LabelledMesh& labelled_;
  const std::vector<int>& nodes_;
  const CellPositions& positions_;
  int order_ = 1;
  std::unordered_map<std::uint64_t, int> middle_of_edge_;
  SplitCells result_;
};

using Triangle = std::array<int, 3>;

Triangle sorted_triangle(int a, int b, int c) {
  Triangle triangle{a, b, c};
  std::sort(triangle.begin(), triangle.end());
  return triangle;
}

/// Throws DataError if a four-sided face coincides with faces of tetrahedra that are divided along its other diagonal;
/// both then lie on the boundary of the divided mesh.
void require_fitting_faces(const LabelledMesh& labelled, const std::vector<int>& nodes, const SplitCells& split) {
  std::set<Triangle> outside;
  for (const BoundaryTriangle& triangle : boundary(TetMesh{{}, split.tets}))
    outside.insert(sorted_triangle(triangle.vertices[0], triangle.vertices[1], triangle.vertices[2]));
  for (const LabelledCell& cell : labelled.cells) {
    for (const auto& face : topology(cell.shape).faces) {
      if (face.size() != 4) continue;
      const int* n = nodes.data() + cell.first;
      const std::size_t start = lowest_corner(face, n);
      const auto corner = [&](std::size_t k) { return n[face[(start + k) % 4]]; };
      const bool other = outside.contains(sorted_triangle(corner(0), corner(1), corner(3))) ||
                         outside.contains(sorted_triangle(corner(1), corner(2), corner(3)));
      if (!other || corner(0) == corner(1) || corner(0) == corner(3) || corner(1) == corner(2) ||
          corner(2) == corner(3))
        continue;
      fail_at(
          labelled, cell.line,
          "a four-sided face of element " + std::to_string(cell.label) +
              " meets tetrahedra that are cut along its other diagonal: put pyramids between, or mesh with one kind");
    }
  }
}

}  // namespace

SplitCells split_cells(const LabelledMesh& labelled, const std::vector<int>& nodes, const CellPositions& positions) {
  SplitCells split = Splitter(labelled, nodes, positions).split();
  const auto is_tet = [](const LabelledCell& cell) { return cell.shape == CellShape::tetrahedron; };
  const auto tets = std::count_if(labelled.cells.begin(), labelled.cells.end(), is_tet);
  if (tets > 0 && tets < static_cast<std::ptrdiff_t>(labelled.cells.size()))
    require_fitting_faces(labelled, nodes, split);
  return split;
}

}  // namespace thinwall::mesh

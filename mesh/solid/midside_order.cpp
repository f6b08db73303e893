#include "mesh/solid/midside_order.hpp"

#include <utility>

namespace thinwall::mesh {

namespace {

constexpr std::pair<std::size_t, std::size_t> right_order{0, 0};
constexpr std::pair<std::size_t, std::size_t> last_two{4, 5};

/// The first two edges of a cell whose middles are exchanged, or {0, 0} if none are.
std::pair<std::size_t, std::size_t> exchanged(const LabelledMesh& labelled, const LabelledCell& cell,
                                              const std::vector<int>& nodes) {
  const CellTopology& shape = topology(cell.shape);
  const auto x = [&](std::size_t local) -> const Eigen::Vector3d& {
    return labelled.nodes[static_cast<std::size_t>(nodes[cell.first + local])].x;
  };
  for (std::size_t i = 0; i < shape.edges.size(); ++i) {
    for (std::size_t j = i + 1; j < shape.edges.size(); ++j) {
      const Eigen::Vector3d apart = x(shape.corners + i) - x(shape.corners + j);
      const auto [a, b] = shape.edges[i];
      const auto [c, d] = shape.edges[j];
      if (apart.dot(x(a) + x(b) - x(c) - x(d)) < 0.0) return {i, j};
    }
  }
  return right_order;
}

[[noreturn]] void fail_disorder(const LabelledMesh& labelled, const LabelledCell& cell,
                                std::pair<std::size_t, std::size_t> edges, bool others_are_right) {
  const std::size_t corners = topology(cell.shape).corners;
  fail_at(labelled, cell.line,
          "the mid-edge nodes of element " + std::to_string(cell.label) + " are not in the format's order: nodes " +
              std::to_string(labelled.cell_nodes[cell.first + corners + edges.first]) + " and " +
              std::to_string(labelled.cell_nodes[cell.first + corners + edges.second]) +
              " each lie nearer to the other's edge" +
              (others_are_right ? ", and the elements before it are in another order" : "") +
              "; write the mesh again by the program that made it");
}

}  // namespace

bool put_middles_right(const LabelledMesh& labelled, std::vector<int>& nodes) {
  std::size_t swapped = 0;
  std::size_t looked_at = 0;
  for (const LabelledCell& cell : labelled.cells) {
    if (cell_order(cell.shape, cell.nodes) != 2) continue;
    const auto edges = exchanged(labelled, cell, nodes);
    const bool is_tet = cell.shape == CellShape::tetrahedron;
    if (edges != right_order && !(is_tet && edges == last_two)) fail_disorder(labelled, cell, edges, false);
    if (!is_tet) continue;
    if ((edges == last_two) != (swapped > 0) && looked_at > 0) {
      fail_disorder(labelled, cell, last_two, true);
    }
    ++looked_at;
    if (edges == right_order) continue;
    ++swapped;
    std::swap(nodes[cell.first + 8], nodes[cell.first + 9]);
    if (const auto still = exchanged(labelled, cell, nodes); still != right_order)
      fail_disorder(labelled, cell, still, false);
  }
  return swapped > 0;
}

}  // namespace thinwall::mesh

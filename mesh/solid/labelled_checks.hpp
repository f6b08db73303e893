#pragma once
// Checks of the numbers of a file's nodes and elements, before a mesh is made of them.

#include <string>
#include <vector>

#include "mesh/solid/labelled_mesh.hpp"

namespace thinwall::mesh {

/// Sorts the nodes by label and returns for each of labelled.cell_nodes its row among them. Elements on the same nodes
/// become one if the format repeats them, and sets are changed accordingly; wedges are turned if the format has both
/// senses. Both are noted in `notices`. Throws DataError as mesh::solid_mesh() says. Cost O(n log n).
[[nodiscard]] std::vector<int> checked_rows(LabelledMesh& labelled, std::vector<std::string>& notices);

/// The row of a node among the sorted ones. Throws DataError for the line if there is no such node. Cost O(1) if the
/// numbers have no gaps, O(log n) otherwise.
[[nodiscard]] int row_of_node(const LabelledMesh& labelled, std::int64_t label, std::int64_t line);

/// Sorts the nodes by label. Throws DataError for a label that occurs twice or exceeds 2³¹ − 1, and for a position that
/// is not finite.
void sort_nodes(LabelledMesh& labelled);

/// The role of a node in the cells.
enum class NodeRole : char { unused, corner, middle };

/// The role of each node in the cells. Throws DataError for a node that is a corner of one cell and lies within an edge
/// of another.
[[nodiscard]] std::vector<NodeRole> node_roles(const LabelledMesh& labelled, const std::vector<int>& rows);

}  // namespace thinwall::mesh

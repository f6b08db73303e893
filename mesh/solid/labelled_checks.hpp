#pragma once
// The numbers of a file's nodes and elements, looked at before a mesh is made of them.

#include <string>
#include <vector>

#include "mesh/solid/labelled_mesh.hpp"

namespace thinwall::mesh {

/// Sorts the nodes by label and gives for each of labelled.cell_nodes its row among them. Elements on the same nodes
/// become one where the format repeats them (its sets follow), wedges are turned where the format has both senses; both
/// are told in `notices`. Throws DataError as mesh::solid_mesh says. Cost O(n log n).
[[nodiscard]] std::vector<int> checked_rows(LabelledMesh& labelled, std::vector<std::string>& notices);

/// The row of a node among the sorted ones; throws DataError for the line if it is not there. Cost O(1) without gaps in
/// the numbers, O(log n) otherwise.
[[nodiscard]] int row_of_node(const LabelledMesh& labelled, std::int64_t label, std::int64_t line);

/// Sorts the nodes by label; throws DataError for one that is there twice, beyond 2³¹ − 1, or at a place that is not
/// finite.
void sort_nodes(LabelledMesh& labelled);

/// The role of a node in the cells.
enum class NodeRole : char { unused, corner, middle };

/// The role of each node in the cells. Throws DataError for one that is a corner here and within an edge there.
[[nodiscard]] std::vector<NodeRole> node_roles(const LabelledMesh& labelled, const std::vector<int>& rows);

}  // namespace thinwall::mesh

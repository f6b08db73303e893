#pragma once
// Nodes that join a set because all corners around them are in it.

#include <vector>

#include "mesh/solid/solid_mesh.hpp"

namespace thinwall::mesh {

/// Nodes that belong to corners: of a face, of an element.
struct NodesWithin {
  std::vector<int> corners;
  std::vector<int> nodes;
};

/// Adds the nodes of every group whose corners are all in a set to that set, which stays ascending. Cost O(nodes of the
/// sets + groups · log).
void join_sets(std::vector<NodeSet>& sets, const std::vector<NodesWithin>& groups);

}  // namespace thinwall::mesh

#pragma once
// Completion of node sets by the nodes between corners that are all in the set.

#include <vector>

#include "mesh/solid/solid_mesh.hpp"

namespace thinwall::mesh {

/// The corners of a face or an element, and the nodes within it that belong to them.
struct NodesWithin {
  std::vector<int> corners;
  std::vector<int> nodes;
};

/// Adds the nodes of every group whose corners are all in a set to that set, which stays ascending. Cost O(nodes of the
/// sets + groups · log).
void join_sets(std::vector<NodeSet>& sets, const std::vector<NodesWithin>& groups);

}  // namespace thinwall::mesh

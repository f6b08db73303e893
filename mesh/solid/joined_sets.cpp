#include "mesh/solid/joined_sets.hpp"

#include <algorithm>
#include <unordered_map>

namespace thinwall::mesh {

void join_sets(std::vector<NodeSet>& sets, const std::vector<NodesWithin>& groups) {
  std::unordered_map<int, std::vector<const NodesWithin*>> of_lowest;
  for (const NodesWithin& group : groups)
    of_lowest[*std::min_element(group.corners.begin(), group.corners.end())].push_back(&group);
  for (NodeSet& set : sets) {
    std::vector<int> joined = set.nodes;
    const auto has = [&set](int node) { return std::binary_search(set.nodes.begin(), set.nodes.end(), node); };
    for (const int node : set.nodes) {
      const auto found = of_lowest.find(node);
      if (found == of_lowest.end()) continue;
      for (const NodesWithin* group : found->second)
        if (std::all_of(group->corners.begin(), group->corners.end(), has))
          joined.insert(joined.end(), group->nodes.begin(), group->nodes.end());
    }
    std::sort(joined.begin(), joined.end());
    joined.erase(std::unique(joined.begin(), joined.end()), joined.end());
    set.nodes = std::move(joined);
  }
}

}  // namespace thinwall::mesh

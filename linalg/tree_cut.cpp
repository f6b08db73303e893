#include "linalg/tree_cut.hpp"

#include <algorithm>
#include <queue>

namespace thinwall::linalg {

TreeCut tree_cut(const SymbolicFactor& L) {
  const auto count = static_cast<std::size_t>(L.count());
  const std::vector<int> parent = parents(L);
  std::vector<double> weight(count);  // number of values in the subtree below each supernode, itself included
  std::vector<std::vector<int>> children(count + 1);
  for (std::size_t s = 0; s < count; ++s) {
    weight[s] += static_cast<double>(L.first_value[s + 1] - L.first_value[s]);
    if (parent[s] >= 0) weight[static_cast<std::size_t>(parent[s])] += weight[s];
    children[parent[s] >= 0 ? static_cast<std::size_t>(parent[s]) : count].push_back(static_cast<int>(s));
  }
  // The root of the heaviest subtree is moved to the top, and its children's subtrees take its place, until every
  // subtree holds at most 1/24 of all values (or 1e5, which are not worth cutting): sixteen groups can then be filled
  // evenly.
  double total = 0.0;
  std::priority_queue<std::pair<double, int>> open;
  for (const int root : children[count]) {
    open.emplace(weight[static_cast<std::size_t>(root)], root);
    total += weight[static_cast<std::size_t>(root)];
  }
  TreeCut cut;
  std::vector<char> in_top(count, 0);
  while (!open.empty() && open.top().first > std::max(total / 24.0, 1e5)) {
    const auto s = static_cast<std::size_t>(open.top().second);
    open.pop();
    in_top[s] = 1;
    for (const int child : children[s]) open.emplace(weight[static_cast<std::size_t>(child)], child);
  }
  std::vector<int> group(count, -1);
  cut.groups.resize(16);
  std::vector<double> load(cut.groups.size(), 0.0);
  for (; !open.empty(); open.pop()) {  // the heaviest subtree first, to the group with the least load
    const auto lightest = std::min_element(load.begin(), load.end());
    *lightest += open.top().first;
    group[static_cast<std::size_t>(open.top().second)] = static_cast<int>(lightest - load.begin());
  }
  cut.place_in_top.assign(L.permutation.size(), -1);
  // The rest of a subtree joins the group of its root. A parent comes after its children, so that it is visited first.
  for (std::size_t s = count; s-- > 0;) {
    if (in_top[s] == 0 && group[s] < 0) group[s] = group[static_cast<std::size_t>(parent[s])];
  }
  for (std::size_t s = 0; s < count; ++s) {
    if (in_top[s] == 0) {
      cut.groups[static_cast<std::size_t>(group[s])].push_back(static_cast<int>(s));
      continue;
    }
    cut.top.push_back(static_cast<int>(s));
    for (int row = L.first_column[s]; row < L.first_column[s + 1]; ++row)
      cut.place_in_top[static_cast<std::size_t>(row)] = cut.rows_in_top++;
  }
  return cut;
}

}  // namespace thinwall::linalg

#include "fem/node_graph.hpp"

#include <algorithm>

#include "core/parallel.hpp"

namespace thinwall::fem {

Lists incidences(const mesh::LagrangeNodes& nodes) {
  const auto count = static_cast<std::size_t>(nodes.positions.rows());
  const int* local = nodes.elements.data();
  const auto places = static_cast<std::size_t>(nodes.elements.size());
  Lists lists;
  lists.start.assign(count + 1, 0);
  for (std::size_t k = 0; k < places; ++k) ++lists.start[static_cast<std::size_t>(local[k]) + 1];
  for (std::size_t i = 0; i < count; ++i) lists.start[i + 1] += lists.start[i];
  lists.items.resize(places);
  std::vector<std::ptrdiff_t> next(lists.start.begin(), lists.start.end() - 1);
  for (std::size_t k = 0; k < places; ++k)
    lists.items[static_cast<std::size_t>(next[static_cast<std::size_t>(local[k])]++)] = static_cast<int>(k);
  return lists;
}

Lists neighbours(const mesh::LagrangeNodes& nodes, const Lists& incidences) {
  const auto count = static_cast<std::size_t>(nodes.positions.rows());
  const Eigen::Index per_element = nodes.elements.cols();
  constexpr std::size_t pieces = 16;
  std::vector<std::vector<int>> found(pieces);
  Lists lists;
  lists.start.assign(count + 1, 0);
  core::parallel_for(pieces, [&](std::size_t piece) {
    std::vector<int> seen(count, -1);
    std::vector<int>& items = found[piece];
    for (std::size_t node = piece * count / pieces; node < (piece + 1) * count / pieces; ++node) {
      const auto first = static_cast<std::ptrdiff_t>(items.size());
      const int self = static_cast<int>(node);
      for (const int* place = incidences.begin(self); place != incidences.end(self); ++place) {
        const int* element = nodes.elements.data() + *place / per_element * per_element;
        for (Eigen::Index a = 0; a < per_element; ++a) {
          int& last = seen[static_cast<std::size_t>(element[a])];
          if (last == self) continue;
          last = self;
          items.push_back(element[a]);
        }
      }
      std::sort(items.begin() + first, items.end());
      lists.start[node + 1] = static_cast<std::ptrdiff_t>(items.size()) - first;
    }
  });
  for (std::size_t i = 0; i < count; ++i) lists.start[i + 1] += lists.start[i];
  lists.items.reserve(static_cast<std::size_t>(lists.start.back()));
  for (const auto& items : found) lists.items.insert(lists.items.end(), items.begin(), items.end());
  return lists;
}

}  // namespace thinwall::fem

#include "linalg/minimum_fill.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace thinwall::linalg {

namespace {

/// A graph from which nodes are eliminated one by one, with the fill that eliminating each of the remaining ones would
/// cause. A set of nodes is stored as a row of bits, so that intersections and differences of neighbourhoods are
/// operations on machine words.
class Elimination {
 public:
  explicit Elimination(const MatrixGraph& graph)
      : nodes_(static_cast<std::size_t>(graph.size())),
        words_((nodes_ + 63) / 64),
        adjacent_(nodes_ * words_, 0),
        fill_(nodes_, 0) {
    weight_.reserve(nodes_);
    for (std::size_t v = 0; v < nodes_; ++v) {
      weight_.push_back(static_cast<std::int64_t>(graph.rows[v].size()));
      for (const int other : graph.neighbours[v]) insert(v, static_cast<std::size_t>(other));
      left_.push_back(v);
    }
    for (std::size_t v = 0; v < nodes_; ++v) {
      each_of(v, [&](std::size_t i) { fill_[v] += weight_[i] * outside(v, i); });
      fill_[v] /= 2;  // both (i, j) and (j, i) were counted
    }
  }

  /// Eliminates the node with the least fill and returns it.
  std::size_t take_next() {
    const auto least =
        std::min_element(left_.begin(), left_.end(), [&](std::size_t a, std::size_t b) { return fill_[a] < fill_[b]; });
    const std::size_t v = *least;
    left_.erase(least);
    std::vector<std::size_t> around;
    each_of(v, [&](std::size_t i) { around.push_back(i); });
    if (fill_[v] > 0) connect(around);
    for (const std::size_t i : around) {
      // When v leaves the graph, the fill of its neighbour i loses the pairs of v with the other neighbours of i.
      fill_[i] -= weight_[v] * outside(i, v);
      row(i)[v / 64] &= ~bit(v);
    }
    return v;
  }

 private:
  static std::uint64_t bit(std::size_t v) { return std::uint64_t{1} << (v % 64); }
  [[nodiscard]] std::uint64_t* row(std::size_t v) { return adjacent_.data() + v * words_; }
  [[nodiscard]] bool are_adjacent(std::size_t i, std::size_t j) { return (row(i)[j / 64] & bit(j)) != 0; }
  void insert(std::size_t v, std::size_t other) { row(v)[other / 64] |= bit(other); }

  /// Calls body(k) for every k in the set of bits word(0), word(1), …
  template <class Word, class Body>
  void each_in(const Word& word, const Body& body) {
    for (std::size_t w = 0; w < words_; ++w) {
      for (std::uint64_t bits = word(w); bits != 0; bits &= bits - 1)
        body(64 * w + static_cast<std::size_t>(std::countr_zero(bits)));
    }
  }
  /// Calls body(i) for every neighbour i of v that has not been eliminated.
  template <class Body>
  void each_of(std::size_t v, const Body& body) {
    each_in([a = row(v)](std::size_t w) { return a[w]; }, body);
  }

  /// The number of rows of the nodes in adj(v) \ adj(i) \ {i}: neighbours of v that are not yet adjacent to i.
  std::int64_t outside(std::size_t v, std::size_t i) {
    std::int64_t sum = 0;
    each_in([a = row(v), b = row(i)](std::size_t w) { return a[w] & ~b[w]; },
            [&](std::size_t k) { sum += weight_[k]; });
    return are_adjacent(v, i) ? sum - weight_[i] : sum;
  }

  /// Makes the nodes adjacent to each other and corrects the fills. A new edge (i, j) removes the pair from the fill of
  /// every common neighbour of i and j, and adds to the fill of i (of j) the pairs of j (of i) with those neighbours
  /// that are not adjacent to it. No other fill changes, so that all stay exact.
  void connect(const std::vector<std::size_t>& nodes) {
    for (const std::size_t i : nodes) {
      for (const std::size_t j : nodes) {
        if (j <= i || are_adjacent(i, j)) continue;
        const std::int64_t pair = weight_[i] * weight_[j];
        each_in([a = row(i), b = row(j)](std::size_t w) { return a[w] & b[w]; },
                [&](std::size_t k) { fill_[k] -= pair; });
        fill_[i] += weight_[j] * outside(i, j);
        fill_[j] += weight_[i] * outside(j, i);
        insert(i, j);
        insert(j, i);
      }
    }
  }

  std::size_t nodes_, words_;
  std::vector<std::uint64_t> adjacent_;
  std::vector<std::int64_t> weight_, fill_;
  std::vector<std::size_t> left_;  // nodes not yet eliminated, ascending
};

}  // namespace

std::vector<int> minimum_fill_order(const MatrixGraph& graph) {
  Elimination elimination(graph);
  std::vector<int> order;
  order.reserve(graph.rows.size());
  for (int i = 0; i < graph.size(); ++i) order.push_back(static_cast<int>(elimination.take_next()));
  return order;
}

}  // namespace thinwall::linalg

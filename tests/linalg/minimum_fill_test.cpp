#include "linalg/minimum_fill.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "linalg/ordering.hpp"
#include "linalg/symbolic_factor.hpp"
#include "tests/linalg/grid_problem.hpp"

namespace thinwall::linalg::minimum_fill_test {
namespace {

/// Nodes of one to four rows, edges at random.
MatrixGraph random_graph(int nodes, int edges, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<int> node(0, nodes - 1), rows(1, 4);
  MatrixGraph graph;
  graph.neighbours.resize(static_cast<std::size_t>(nodes));
  int next = 0;
  for (int v = 0; v < nodes; ++v) {
    graph.rows.emplace_back();
    for (int k = rows(random); k > 0; --k) graph.rows.back().push_back(next++);
  }
  std::set<std::pair<int, int>> there;
  for (int k = 0; k < edges; ++k) {
    const auto [a, b] = std::minmax({node(random), node(random)});
    if (a == b || !there.emplace(a, b).second) continue;
    graph.neighbours[static_cast<std::size_t>(a)].push_back(b);
    graph.neighbours[static_cast<std::size_t>(b)].push_back(a);
  }
  return graph;
}

/// The definition: before each step the fill of every node that is left, pair by pair.
std::vector<int> by_definition(const MatrixGraph& graph) {
  const int n = graph.size();
  std::vector<std::set<int>> around(static_cast<std::size_t>(n));
  for (int v = 0; v < n; ++v) around[static_cast<std::size_t>(v)] = {graph.around(v).begin(), graph.around(v).end()};
  const auto adjacent = [&](int v) -> std::set<int>& { return around[static_cast<std::size_t>(v)]; };
  const auto weight = [&](int v) { return graph.rows[static_cast<std::size_t>(v)].size(); };
  const auto fill = [&](int v) {
    std::size_t sum = 0;
    for (const int i : adjacent(v)) {
      for (const int j : adjacent(v)) sum += i < j && !adjacent(i).contains(j) ? weight(i) * weight(j) : 0;
    }
    return sum;
  };
  std::set<int> left;
  for (int v = 0; v < n; ++v) left.insert(v);
  std::vector<int> order;
  while (!left.empty()) {
    const int v = *std::min_element(left.begin(), left.end(), [&](int a, int b) { return fill(a) < fill(b); });
    for (const int i : adjacent(v)) {
      for (const int j : adjacent(v)) {
        if (i != j) adjacent(i).insert(j);
      }
    }
    for (const int i : adjacent(v)) adjacent(i).erase(v);
    left.erase(v);
    order.push_back(v);
  }
  return order;
}

TEST(MinimumFill, TakesTheNodeWithTheLeastFillAtEveryStep) {
  for (const auto& [nodes, edges] : {std::pair{1, 0}, {2, 1}, {63, 90}, {64, 200}, {65, 40}, {90, 260}}) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const MatrixGraph graph = random_graph(nodes, edges, seed);
      EXPECT_EQ(minimum_fill_order(graph), by_definition(graph)) << nodes << " nodes, seed " << seed;
    }
  }
}

TEST(MinimumFill, FillsATreeNowhere) {
  MatrixGraph tree = random_graph(200, 0, 1);
  for (int v = 1; v < tree.size(); ++v) {
    const int parent = (v - 1) / 3;
    tree.neighbours[static_cast<std::size_t>(v)].push_back(parent);
    tree.neighbours[static_cast<std::size_t>(parent)].push_back(v);
  }
  std::set<int> gone;
  for (const int v : minimum_fill_order(tree)) {
    const auto& around = tree.around(v);
    EXPECT_LE(std::ranges::count_if(around, [&](int other) { return !gone.contains(other); }), 1);
    gone.insert(v);
  }
  EXPECT_EQ(gone.size(), 200U);
}

TEST(MinimumFill, FillsASmallGridLessThanNestedDissection) {
  const GridProblem grid = grid_problem(30);
  const MatrixGraph graph = matrix_graph(grid.K, grid.node_of_row);
  const FactorCost least = factor_cost(symbolic_factor(graph, minimum_fill_order(graph)));
  const FactorCost dissected = factor_cost(symbolic_factor(graph, elimination_order(graph)));
  EXPECT_LT(least.flops, dissected.flops);
  EXPECT_LT(least.nonzeros, dissected.nonzeros);
}

TEST(PatternGraph, JoinsTheRowsWithOnePatternAndKeepsTheirEdges) {
  // Three rows for each node of a membrane, but one node's third row, which has lost its edge to another node.
  const GridProblem grid = grid_problem(6);
  const SparseMatrix blocks = [&] {
    std::vector<Eigen::Triplet<double>> entries;
    for (int column = 0; column < grid.K.cols(); ++column) {
      for (SparseMatrix::InnerIterator it(grid.K, column); it; ++it) {
        for (int k = 0; k < 9; ++k) {
          const int row = 3 * static_cast<int>(it.row()) + k / 3;
          const int other = 3 * column + k % 3;
          if (std::minmax(row, other) == std::minmax(2, 3)) continue;
          entries.emplace_back(row, other, 1.0);
        }
      }
    }
    SparseMatrix A(3 * grid.K.rows(), 3 * grid.K.rows());
    A.setFromTriplets(entries.begin(), entries.end());
    return A;
  }();
  const MatrixGraph graph = pattern_graph(blocks);
  EXPECT_EQ(graph.size(), 36 + 2) << "the rows 2 and 3 stand alone";
  std::vector<int> set_of(static_cast<std::size_t>(blocks.rows()), -1);
  for (int set = 0; set < graph.size(); ++set) {
    for (const int row : graph.rows[static_cast<std::size_t>(set)]) set_of[static_cast<std::size_t>(row)] = set;
  }
  EXPECT_EQ(std::count(set_of.begin(), set_of.end(), -1), 0) << "every row in a set";
  EXPECT_EQ(set_of[0], set_of[1]);
  EXPECT_NE(set_of[0], set_of[2]);
  EXPECT_EQ(set_of[4], set_of[5]);
  EXPECT_NE(set_of[3], set_of[4]);
  std::set<std::pair<int, int>> edges, expected;
  for (int set = 0; set < graph.size(); ++set) {
    for (const int other : graph.around(set)) EXPECT_TRUE(edges.emplace(set, other).second) << "each edge once";
  }
  for (int column = 0; column < blocks.cols(); ++column) {
    for (SparseMatrix::InnerIterator it(blocks, column); it; ++it) {
      const int a = set_of[static_cast<std::size_t>(it.row())];
      const int b = set_of[static_cast<std::size_t>(column)];
      if (a != b) expected.emplace(a, b);
    }
  }
  EXPECT_EQ(edges, expected);
}

}  // namespace
}  // namespace thinwall::linalg::minimum_fill_test

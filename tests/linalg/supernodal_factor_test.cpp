#include "linalg/supernodal_factor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "linalg/cholmod.hpp"
#include "linalg/large_array.hpp"
#include "linalg/ordering.hpp"
#include "tests/linalg/thread_count.hpp"

namespace thinwall::linalg::supernodal_factor_test {
namespace {

/// Triangles of order 2 on a square grid, three rows a node, random positive definite element matrices.
struct Grid {
  SparseMatrix A;
  std::vector<int> node_of_row;
  std::vector<std::array<int, 3>> middles;  // a node in the middle of an edge, and the ends of the edge
};

Grid quadratic_grid(int n, unsigned seed) {
  const int side = 2 * n + 1;  // nodes along an edge; those with two even coordinates are vertices
  const auto node = [side](int i, int j) { return i * side + j; };
  Grid grid;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  std::vector<Eigen::Triplet<double>> entries;
  for (int e = 0; e < 2 * n * n; ++e) {
    const int i = 2 * (e / 2 / n);
    const int j = 2 * (e / 2 % n);
    const int up = e % 2;  // which half of the square
    const std::array<std::array<int, 2>, 3> corner{{{i, j}, {i + 2, j + 2}, {i + 2 - 2 * up, j + 2 * up}}};
    std::vector<int> nodes;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& a = corner[k];
      const auto& b = corner[(k + 1) % 3];
      nodes.push_back(node(a[0], a[1]));
      nodes.push_back(node((a[0] + b[0]) / 2, (a[1] + b[1]) / 2));
      grid.middles.push_back({nodes.back(), node(a[0], a[1]), node(b[0], b[1])});
    }
    const Eigen::MatrixXd X = Eigen::MatrixXd::NullaryExpr(18, 18, [&] { return value(random); });
    const Eigen::MatrixXd element = X * X.transpose() + Eigen::MatrixXd::Identity(18, 18);
    for (int a = 0; a < 18; ++a) {
      for (int b = 0; b < 18; ++b)
        entries.emplace_back(3 * nodes[static_cast<std::size_t>(a / 3)] + a % 3,
                             3 * nodes[static_cast<std::size_t>(b / 3)] + b % 3, element(a, b));
    }
  }
  grid.A.resize(3 * side * side, 3 * side * side);
  grid.A.setFromTriplets(entries.begin(), entries.end());
  for (int row = 0; row < grid.A.rows(); ++row) grid.node_of_row.push_back(row / 3);
  return grid;
}

struct Values {
  SymbolicFactor L;
  TreeCut cut;
  LargeArray<double> values;
  std::optional<int> failed;
};

Values factored(const Grid& grid) {
  const MatrixGraph graph = matrix_graph(grid.A, grid.node_of_row);
  Values result;
  result.L = symbolic_factor(graph, elimination_order(graph));
  result.cut = tree_cut(result.L);
  result.values = LargeArray<double>(result.L.values());
  result.failed = supernodal_factor({.A = grid.A}, result.L, result.cut, result.values.data());
  return result;
}

/// body(row, column, value) for all entries of the lower triangle that are stored.
template <class Body>
void each_entry(const SymbolicFactor& L, const double* values, const Body& body) {
  for (int s = 0; s < L.count(); ++s) {
    for (int j = 0; j < L.columns(s); ++j) {
      for (std::ptrdiff_t i = j; i < L.height(s); ++i)
        body(L.rows_of(s)[i], L.column(s) + j, values[L.value(s) + j * L.height(s) + i]);
    }
  }
}

TEST(SupernodalFactor, IsTheOneThatCholmodComputes) {
  const Grid grid = quadratic_grid(40, 1);
  const Values ours = factored(grid);
  ASSERT_FALSE(ours.failed);
  ASSERT_FALSE(ours.cut.top.empty());
  CholmodFactor library(CHOLMOD_SUPERNODAL);
  library.common.postorder = 0;  // the same order of rows
  library.common.final_asis = 0;
  library.common.final_super = 0;
  library.common.final_monotonic = 1;
  cholmod_sparse view = cholmod_view(grid.A);
  library.analyse(&view, ours.L.permutation);
  library.factorise(&view);
  ASSERT_EQ(library.L->minor, library.L->n);
  const auto* start = static_cast<const int*>(library.L->p);
  const auto* row = static_cast<const int*>(library.L->i);
  const auto* value = static_cast<const double*>(library.L->x);
  Eigen::SparseMatrix<double> theirs(grid.A.rows(), grid.A.rows());
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < grid.A.rows(); ++j) {
    for (int k = start[j]; k < start[j + 1]; ++k) entries.emplace_back(row[k], j, value[k]);
  }
  theirs.setFromTriplets(entries.begin(), entries.end());
  double worst = 0.0;
  double largest = 0.0;
  double entries_seen = 0.0;
  each_entry(ours.L, ours.values.data(), [&](int i, int j, double v) {
    worst = std::max(worst, std::abs(v - theirs.coeff(i, j)));
    largest = std::max(largest, std::abs(v));
    if (theirs.coeff(i, j) != 0.0) entries_seen += 1.0;
  });
  std::printf("factor of %td rows, %d supernodes: to %.1e of CHOLMOD's\n", grid.A.rows(), ours.L.count(),
              worst / largest);
  EXPECT_LT(worst / largest, 1e-13);
  EXPECT_EQ(entries_seen, (theirs.coeffs().array() != 0.0).count());
}

TEST(SupernodalFactor, IsTheSameBitByBitForAnyNumberOfThreads) {
  const Grid grid = quadratic_grid(40, 2);
  std::vector<double> first;
  for (const int threads : {1, 2, 3, 16}) {
    const ThreadCount count(threads);
    const Values result = factored(grid);
    std::vector<double> values;
    each_entry(result.L, result.values.data(), [&](int, int, double v) { values.push_back(v); });
    if (first.empty()) first = values;
    EXPECT_EQ(first, values) << threads << " threads";
  }
}

TEST(SupernodalFactor, TellsThePivotThatIsNotPositiveInAGroupAndOnTop) {
  const Grid good = quadratic_grid(40, 3);
  const Values whole = factored(good);
  const int in_group = whole.L.column(whole.cut.groups[0].front());
  const int on_top = whole.L.column(whole.cut.top.back());
  for (const int position : {in_group, on_top}) {
    Grid bad = good;
    const int row = whole.L.permutation[static_cast<std::size_t>(position)];
    bad.A.coeffRef(row, row) = -1e6;
    EXPECT_EQ(factored(bad).failed, position);
    bad.A.coeffRef(row, row) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(factored(bad).failed) << "not a number";
  }
}

/// The inverse of a permutation; −1 for what it leaves out.
std::vector<int> positions(const std::vector<int>& order) {
  std::vector<int> position(order.size(), -1);
  for (std::size_t i = 0; i < order.size(); ++i) position[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
  return position;
}

TEST(EliminationOrder, TakesTheMiddleOfAnEdgeWithTheFirstOfItsEnds) {
  const Grid grid = quadratic_grid(20, 4);
  const auto order = elimination_order(matrix_graph(grid.A, grid.node_of_row));
  const std::vector<int> position = positions(order);
  ASSERT_EQ(std::count(position.begin(), position.end(), -1), 0) << "every node once";
  std::vector<char> vertex(order.size(), 0);
  for (const auto& [middle, a, b] : grid.middles)
    vertex[static_cast<std::size_t>(a)] = vertex[static_cast<std::size_t>(b)] = 1;
  constexpr int last = 41 * 41 - 1;
  const std::set<int> corners{0, 40, last - 40, last};  // of the square: other vertices dominate them
  for (const auto& [middle, a, b] : grid.middles) {
    if (corners.contains(a) || corners.contains(b)) continue;
    const int first = std::min(position[static_cast<std::size_t>(a)], position[static_cast<std::size_t>(b)]);
    EXPECT_LT(position[static_cast<std::size_t>(middle)], first);
    // Only nodes of higher order come between, or a corner.
    int between = 0;
    for (int k = position[static_cast<std::size_t>(middle)]; k < first; ++k)
      between += vertex[static_cast<std::size_t>(order[static_cast<std::size_t>(k)])];
    EXPECT_LE(between, 1);
  }
}

TEST(EliminationOrder, FillsNoMoreThanMetisOnAllRows) {
  const Grid grid = quadratic_grid(60, 5);
  const MatrixGraph graph = matrix_graph(grid.A, grid.node_of_row);
  CholmodFactor library(CHOLMOD_SUPERNODAL);
  library.common.method[0].ordering = CHOLMOD_METIS;
  cholmod_sparse view = cholmod_view(grid.A);
  library.L = cholmod_analyze(&view, &library.common);
  const FactorCost ours = factor_cost(symbolic_factor(graph, elimination_order(graph)));
  std::printf("fill: %.3g, METIS on the rows %.3g without the zeros of supernodes\n", ours.nonzeros,
              library.common.lnz);
  EXPECT_LT(ours.nonzeros, 1.15 * library.common.lnz);
}

TEST(SymbolicFactor, CountsValuesBeyondThe32ndBit) {
  // Fifty nodes of a thousand rows, each coupled to all: a dense lower triangle of 50 000 rows.
  MatrixGraph graph;
  for (int node = 0; node < 50; ++node) {
    graph.rows.emplace_back();
    graph.neighbours.emplace_back();
    for (int row = 0; row < 1000; ++row) graph.rows.back().push_back(1000 * node + row);
    for (int other = 0; other < 50; ++other) {
      if (other != node) graph.neighbours.back().push_back(other);
    }
  }
  const SymbolicFactor L = symbolic_factor(graph, elimination_order(graph));
  EXPECT_EQ(L.count(), 1);
  EXPECT_EQ(L.values(), 2'500'000'000);
  EXPECT_EQ(factor_cost(L).nonzeros, 0.5 * 50'000.0 * 50'001.0);
}

}  // namespace
}  // namespace thinwall::linalg::supernodal_factor_test

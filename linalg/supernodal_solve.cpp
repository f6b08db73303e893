#include "linalg/supernodal_solve.hpp"

#include <algorithm>
#include <cstdint>
#include <queue>

#include "core/parallel.hpp"

namespace thinwall::linalg {

namespace {

template <int width>
using Rows = Eigen::Matrix<double, width, Eigen::Dynamic>;

/// One supernode as a dense block: columns × rows, the triangle of its own columns first.
struct Panel {
  const double* values = nullptr;
  std::ptrdiff_t rows = 0;
  std::ptrdiff_t columns = 0;

  [[nodiscard]] double at(std::ptrdiff_t row, std::ptrdiff_t column) const { return values[column * rows + row]; }
};

template <class Index>
Panel panel(const Supernodes<Index>& L, int s) {
  return {L.values + L.first_value[s], static_cast<std::ptrdiff_t>(L.first_row[s + 1] - L.first_row[s]),
          static_cast<std::ptrdiff_t>(L.first_column[s + 1] - L.first_column[s])};
}

/// Y[:, from:to] −= Σ_c x_c L(·, column + c), `count` columns of L at once: one pass over Y for all of them.
template <int width, int count>
void rank_update(const Panel& L, std::ptrdiff_t column, std::ptrdiff_t from, Rows<width>& Y) {
  const Eigen::Matrix<double, width, count> x = Y.template middleCols<count>(column);
  const double* values[count];
  for (int c = 0; c < count; ++c) values[c] = L.values + (column + c) * L.rows;
  for (std::ptrdiff_t row = from; row < L.rows; ++row) {
    Eigen::Matrix<double, width, 1> y = Y.col(row);
    for (int c = 0; c < count; ++c) y -= values[c][row] * x.col(c);
    Y.col(row) = y;
  }
}

/// Y ← [L₁₁⁻¹ Y₁; Y₂ − L₂₁ L₁₁⁻¹ Y₁].
template <int width>
void forward(const Panel& L, Rows<width>& Y) {
  constexpr int step = 4;
  std::ptrdiff_t column = 0;
  for (; column + step <= L.columns; column += step) {
    for (int c = 0; c < step; ++c) {
      Y.col(column + c) /= L.at(column + c, column + c);
      for (int r = c + 1; r < step; ++r) Y.col(column + r) -= L.at(column + r, column + c) * Y.col(column + c);
    }
    rank_update<width, step>(L, column, column + step, Y);
  }
  for (; column < L.columns; ++column) {
    Y.col(column) /= L.at(column, column);
    rank_update<width, 1>(L, column, column + 1, Y);
  }
}

/// Σ_row L(row, column + c) Y[:, row] over the rows from `from` on, for `count` columns.
template <int width, int count>
Eigen::Matrix<double, width, count> dot_products(const Panel& L, std::ptrdiff_t column, std::ptrdiff_t from,
                                                 const Rows<width>& Y) {
  Eigen::Matrix<double, width, count> sum = Eigen::Matrix<double, width, count>::Zero();
  const double* values[count];
  for (int c = 0; c < count; ++c) values[c] = L.values + (column + c) * L.rows;
  for (std::ptrdiff_t row = from; row < L.rows; ++row) {
    const Eigen::Matrix<double, width, 1> y = Y.col(row);
    for (int c = 0; c < count; ++c) sum.col(c) += values[c][row] * y;
  }
  return sum;
}

/// Y₁ ← L₁₁⁻ᵀ (Y₁ − L₂₁ᵀ Y₂).
template <int width>
void backward(const Panel& L, Rows<width>& Y) {
  constexpr int step = 4;
  std::ptrdiff_t column = L.columns;
  for (; column % step != 0; --column) {
    Y.col(column - 1) -= dot_products<width, 1>(L, column - 1, column, Y);
    Y.col(column - 1) /= L.at(column - 1, column - 1);
  }
  for (; column > 0; column -= step) {
    const std::ptrdiff_t first = column - step;
    Y.template middleCols<step>(first) -= dot_products<width, step>(L, first, column, Y);
    for (int c = step - 1; c >= 0; --c) {
      for (int r = c + 1; r < step; ++r) Y.col(first + c) -= L.at(first + r, first + c) * Y.col(first + r);
      Y.col(first + c) /= L.at(first + c, first + c);
    }
  }
}

/// Forward elimination over some supernodes; `add(row, y)` takes what goes to a row below.
template <int width, class Index, class Add>
void eliminate(const Supernodes<Index>& L, const std::vector<int>& supernodes, Rows<width>& X, const Add& add) {
  Rows<width> Y;
  for (const int s : supernodes) {
    const Panel block = panel(L, s);
    const Index* row = L.rows + L.first_row[s];
    if (Y.cols() < block.rows) Y.resize(width, block.rows);
    Y.leftCols(block.columns) = X.middleCols(L.first_column[s], block.columns);
    Y.middleCols(block.columns, block.rows - block.columns).setZero();
    forward<width>(block, Y);
    X.middleCols(L.first_column[s], block.columns) = Y.leftCols(block.columns);
    for (std::ptrdiff_t k = block.columns; k < block.rows; ++k) add(row[k], Y.col(k));
  }
}

template <int width, class Index>
void substitute(const Supernodes<Index>& L, const std::vector<int>& supernodes, Rows<width>& X) {
  Rows<width> Y;
  for (auto s = supernodes.rbegin(); s != supernodes.rend(); ++s) {
    const Panel block = panel(L, *s);
    const Index* row = L.rows + L.first_row[*s];
    if (Y.cols() < block.rows) Y.resize(width, block.rows);
    for (std::ptrdiff_t k = 0; k < block.rows; ++k) Y.col(k) = X.col(row[k]);
    backward<width>(block, Y);
    X.middleCols(L.first_column[*s], block.columns) = Y.leftCols(block.columns);
  }
}

/// Parent of each supernode in the elimination tree: the one that owns its first row below; −1 for a root.
template <class Index>
std::vector<int> parents(const Supernodes<Index>& L) {
  std::vector<int> owner(static_cast<std::size_t>(L.first_column[L.count]));
  for (int s = 0; s < L.count; ++s)
    std::fill(owner.begin() + L.first_column[s], owner.begin() + L.first_column[s + 1], s);
  std::vector<int> parent(static_cast<std::size_t>(L.count), -1);
  for (int s = 0; s < L.count; ++s) {
    const Index below = L.first_row[s] + (L.first_column[s + 1] - L.first_column[s]);
    if (below < L.first_row[s + 1])
      parent[static_cast<std::size_t>(s)] = owner[static_cast<std::size_t>(L.rows[below])];
  }
  return parent;
}

}  // namespace

template <class Index>
SolvePlan solve_plan(const Supernodes<Index>& L) {
  const auto count = static_cast<std::size_t>(L.count);
  const std::vector<int> parent = parents(L);
  std::vector<double> weight(count);  // values in the subtree
  std::vector<std::vector<int>> children(count + 1);
  for (std::size_t s = 0; s < count; ++s) {
    const Panel block = panel(L, static_cast<int>(s));
    weight[s] += static_cast<double>(block.rows * block.columns);
    if (parent[s] >= 0) weight[static_cast<std::size_t>(parent[s])] += weight[s];
    children[parent[s] >= 0 ? static_cast<std::size_t>(parent[s]) : count].push_back(static_cast<int>(s));
  }
  // The heaviest subtree is opened until all are light; what is opened is the top.
  double total = 0.0;
  std::priority_queue<std::pair<double, int>> open;
  for (const int root : children[count]) {
    open.emplace(weight[static_cast<std::size_t>(root)], root);
    total += weight[static_cast<std::size_t>(root)];
  }
  SolvePlan plan;
  std::vector<char> in_top(count, 0);
  while (!open.empty() && open.top().first > std::max(total / 24.0, 1e5)) {
    const auto s = static_cast<std::size_t>(open.top().second);
    open.pop();
    in_top[s] = 1;
    for (const int child : children[s]) open.emplace(weight[static_cast<std::size_t>(child)], child);
  }
  std::vector<int> group(count, -1);
  plan.groups.resize(16);
  std::vector<double> load(plan.groups.size(), 0.0);
  for (; !open.empty(); open.pop()) {  // the heaviest first, to the group with the least
    const auto lightest = std::min_element(load.begin(), load.end());
    *lightest += open.top().first;
    group[static_cast<std::size_t>(open.top().second)] = static_cast<int>(lightest - load.begin());
  }
  plan.place_in_top.assign(static_cast<std::size_t>(L.first_column[L.count]), -1);
  for (std::size_t s = count; s-- > 0;) {  // a parent comes after its children
    if (in_top[s] == 0 && group[s] < 0) group[s] = group[static_cast<std::size_t>(parent[s])];
  }
  for (std::size_t s = 0; s < count; ++s) {
    if (in_top[s] == 0) {
      plan.groups[static_cast<std::size_t>(group[s])].push_back(static_cast<int>(s));
      continue;
    }
    plan.top.push_back(static_cast<int>(s));
    for (Index row = L.first_column[s]; row < L.first_column[s + 1]; ++row)
      plan.place_in_top[static_cast<std::size_t>(row)] = plan.rows_in_top++;
  }
  return plan;
}

template <int width, class Index>
void supernodal_solve(const Supernodes<Index>& L, const SolvePlan& plan, Rows<width>& X) {
  const auto* place = plan.place_in_top.data();
  std::vector<Rows<width>> above(plan.groups.size());
  core::parallel_for(plan.groups.size(), [&](std::size_t g) {
    above[g] = Rows<width>::Zero(width, plan.rows_in_top);
    eliminate<width>(L, plan.groups[g], X, [&](Index row, const auto& y) {
      if (place[row] < 0) {
        X.col(row) += y;
      } else {
        above[g].col(place[row]) += y;
      }
    });
  });
  for (std::size_t row = 0; row < plan.place_in_top.size(); ++row) {
    if (place[row] < 0) continue;
    for (const auto& part : above) X.col(static_cast<std::ptrdiff_t>(row)) += part.col(place[row]);
  }
  eliminate<width>(L, plan.top, X, [&](Index row, const auto& y) { X.col(row) += y; });
  substitute<width>(L, plan.top, X);
  core::parallel_for(plan.groups.size(), [&](std::size_t g) { substitute<width>(L, plan.groups[g], X); });
}

template SolvePlan solve_plan(const Supernodes<int>&);
template SolvePlan solve_plan(const Supernodes<std::int64_t>&);
template void supernodal_solve<4>(const Supernodes<int>&, const SolvePlan&, Rows<4>&);
template void supernodal_solve<8>(const Supernodes<int>&, const SolvePlan&, Rows<8>&);
template void supernodal_solve<16>(const Supernodes<int>&, const SolvePlan&, Rows<16>&);
template void supernodal_solve<4>(const Supernodes<std::int64_t>&, const SolvePlan&, Rows<4>&);
template void supernodal_solve<8>(const Supernodes<std::int64_t>&, const SolvePlan&, Rows<8>&);
template void supernodal_solve<16>(const Supernodes<std::int64_t>&, const SolvePlan&, Rows<16>&);

}  // namespace thinwall::linalg

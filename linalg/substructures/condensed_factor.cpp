#include "linalg/substructures/condensed_factor.hpp"

#include <cblas.h>

#include <string>

#include "core/error.hpp"
#include "core/memory.hpp"
#include "linalg/factor_bytes.hpp"
#include "linalg/matrix_graph.hpp"
#include "linalg/ordering.hpp"
#include "linalg/supernodal_factor.hpp"
#include "linalg/supernodal_solve.hpp"

namespace thinwall::linalg {

namespace {

/// The graph with edges between all nodes of the border: whatever lies inside, these are then eliminated last.
void join(MatrixGraph& graph, const std::vector<int>& border, const std::vector<char>& in_border) {
  for (const int node : border) {
    std::vector<int>& around = graph.neighbours[static_cast<std::size_t>(node)];
    std::erase_if(around, [&](int other) { return in_border[static_cast<std::size_t>(other)] != 0; });
    for (const int other : border) {
      if (other != node) around.push_back(other);
    }
  }
}

/// The structure of the factor of A that eliminates the border last, the inner rows by nested dissection.
SymbolicFactor border_last(const SparseMatrix& A, const std::vector<int>& border, const std::vector<int>& node_of_row) {
  MatrixGraph graph = matrix_graph(A, node_of_row);
  std::vector<int> node_at(static_cast<std::size_t>(A.rows()));
  for (int node = 0; node < graph.size(); ++node) {
    for (const int row : graph.rows[static_cast<std::size_t>(node)]) node_at[static_cast<std::size_t>(row)] = node;
  }
  std::vector<char> in_border(graph.rows.size(), 0);
  for (const int row : border) in_border[static_cast<std::size_t>(node_at[static_cast<std::size_t>(row)])] = 1;
  std::vector<int> inner, outer, order;
  for (int node = 0; node < graph.size(); ++node)
    (in_border[static_cast<std::size_t>(node)] != 0 ? outer : inner).push_back(node);
  for (const int i : least_fill_order(part_of(graph, inner))) order.push_back(inner[static_cast<std::size_t>(i)]);
  order.insert(order.end(), outer.begin(), outer.end());
  join(graph, outer, in_border);
  return symbolic_factor(graph, order);
}

}  // namespace

CondensedFactor::CondensedFactor(const SparseMatrix& A, const std::vector<int>& border,
                                 const std::vector<int>& node_of_row)
    : L_(border_last(A, border, node_of_row)), cut_(tree_cut(L_)) {
  core::require_memory(factor_bytes(L_, cut_), "the factor of a domain of " + std::to_string(A.rows()) + " rows");
  values_ = LargeArray<double>(L_.values());
  if (supernodal_factor({.A = A}, L_, cut_, values_.data())) {
    throw core::NumericalError("the matrix of a domain of " + std::to_string(A.rows()) +
                               " rows is not positive definite: a motion without stiffness, or an element turned "
                               "inside out");
  }
  condense(border);
}

void CondensedFactor::condense(const std::vector<int>& border) {
  // A displacement divided by this number, twice, is none beside any other.
  constexpr double immovable = 1e100;
  std::vector<int> number(L_.permutation.size(), -1);  // for each new position its place in the border
  {
    std::vector<int> place(L_.permutation.size(), -1);
    for (std::size_t k = 0; k < border.size(); ++k) place[static_cast<std::size_t>(border[k])] = static_cast<int>(k);
    for (std::size_t i = 0; i < number.size(); ++i) number[i] = place[static_cast<std::size_t>(L_.permutation[i])];
  }
  const auto size = static_cast<int>(border.size());
  Eigen::MatrixXd L_bb = Eigen::MatrixXd::Zero(size, size);
  for (int s = 0; s < L_.count(); ++s) {
    const std::ptrdiff_t height = L_.height(s);
    const int* rows = L_.rows_of(s);
    for (int j = 0; j < L_.columns(s); ++j) {
      const int column = number[static_cast<std::size_t>(L_.column(s) + j)];
      if (column < 0) continue;
      double* values = values_.data() + L_.value(s) + j * height;
      for (std::ptrdiff_t k = j; k < height; ++k) {
        L_bb(number[static_cast<std::size_t>(rows[k])], column) = values[k];
        values[k] = k == j ? immovable : 0.0;
      }
    }
  }
  Eigen::MatrixXd lower = Eigen::MatrixXd::Zero(size, size);
  if (size > 0)
    cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, size, size, 1.0, L_bb.data(), size, 0.0, lower.data(), size);
  S_ = lower.selfadjointView<Eigen::Lower>();
}

Eigen::MatrixXd CondensedFactor::solve(const Eigen::Ref<const Eigen::MatrixXd>& B) const {
  return supernodal_solution(L_, cut_, values_.data(), B);
}

}  // namespace thinwall::linalg

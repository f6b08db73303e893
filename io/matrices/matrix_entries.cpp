#include "io/matrices/matrix_entries.hpp"

#include <algorithm>
#include <tuple>

#include "core/error.hpp"

namespace thinwall::io {

namespace {

using dynamics::NodeDof;
using Entry = MatrixEntry<int>;

/// Sorts the entries so that mirror images lie beside each other, that of the upper triangle first.
void sort_in_pairs(std::vector<Entry>& entries) {
  const auto place = [](const Entry& entry) {
    return std::tuple(std::max(entry.row, entry.column), std::min(entry.row, entry.column), entry.row > entry.column);
  };
  std::stable_sort(entries.begin(), entries.end(), [&](const Entry& a, const Entry& b) { return place(a) < place(b); });
}

void require_once(const MatrixEntries& matrix, const std::vector<Entry>& sorted) {
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end(), [](const Entry& a, const Entry& b) {
    return a.row == b.row && a.column == b.column;
  });
  if (twice == sorted.end()) return;
  const Entry& again = *(twice + 1);
  throw core::DataError(matrix.path + ":" + std::to_string(again.line) + ": the entry of row " +
                        std::to_string(again.row + 1) + " and column " + std::to_string(again.column + 1) +
                        " is there twice, first on line " + std::to_string(twice->line) +
                        "; export assembled matrices");
}

}  // namespace

std::vector<NodeDof> dofs_of(const std::vector<const LabelledEntries*>& matrices) {
  std::vector<NodeDof> dofs;
  for (const LabelledEntries* matrix : matrices) {
    for (const auto& entry : matrix->entries) {
      dofs.push_back(entry.row);
      dofs.push_back(entry.column);
    }
    std::sort(dofs.begin(), dofs.end());
    dofs.erase(std::unique(dofs.begin(), dofs.end()), dofs.end());
  }
  return dofs;
}

MatrixEntries in_rows(const LabelledEntries& labelled, const std::vector<NodeDof>& dofs) {
  MatrixEntries matrix{labelled.path, static_cast<int>(dofs.size()), {}, labelled.may_be_half};
  matrix.entries.reserve(labelled.entries.size());
  const auto row_of = [&](const NodeDof& dof) {
    return static_cast<int>(std::lower_bound(dofs.begin(), dofs.end(), dof) - dofs.begin());
  };
  for (const auto& entry : labelled.entries)
    matrix.entries.push_back({row_of(entry.row), row_of(entry.column), entry.value, entry.line});
  return matrix;
}

WholeMatrix whole_matrix(const MatrixEntries& matrix) {
  std::vector<Entry> sorted = matrix.entries;
  sort_in_pairs(sorted);
  require_once(matrix, sorted);
  const auto is_pair = [](const Entry& a, const Entry& b) { return a.row == b.column && a.column == b.row; };
  const bool off_diagonal =
      std::any_of(sorted.begin(), sorted.end(), [](const Entry& entry) { return entry.row != entry.column; });
  WholeMatrix whole;
  whole.was_half =
      matrix.may_be_half && off_diagonal && std::adjacent_find(sorted.begin(), sorted.end(), is_pair) == sorted.end();
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(sorted.size() * (whole.was_half ? 2 : 1));
  for (const Entry& entry : sorted) {
    if (entry.value == 0.0) continue;
    triplets.emplace_back(entry.row, entry.column, entry.value);
    if (whole.was_half && entry.row != entry.column) triplets.emplace_back(entry.column, entry.row, entry.value);
  }
  whole.A.resize(matrix.size, matrix.size);
  whole.A.setFromTriplets(triplets.begin(), triplets.end());
  return whole;
}

}  // namespace thinwall::io

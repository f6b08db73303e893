#pragma once
// The entries of a matrix as files list them, by row and column or by node and component.

#include <Eigen/SparseCore>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "dynamics/sparse_model.hpp"

namespace thinwall::io {

/// Largest number of a row, column or node that is accepted: these are stored as int, and one more than the last is
/// needed.
inline constexpr std::int64_t largest_label = std::numeric_limits<int>::max() - 1;

/// An entry in a file: its row and column, as numbers from 0 or as DOFs, its value and its line.
template <class Place>
struct MatrixEntry {
  Place row;
  Place column;
  double value = 0.0;
  int line = 0;
};

/// A square matrix whose rows are given by numbers.
struct MatrixEntries {
  std::string path;
  int size = 0;
  std::vector<MatrixEntry<int>> entries;
  bool may_be_half = true;  ///< the format allows one triangle of a symmetric matrix
};

/// A matrix whose rows are given by DOFs, in any order.
struct LabelledEntries {
  std::string path;
  std::string name;  ///< name in the file; may be empty
  std::vector<MatrixEntry<dynamics::NodeDof>> entries;
  bool may_be_half = true;  ///< as in MatrixEntries
};

/// The DOFs of all the matrices, each once, sorted by node and component. Cost O(n log n) of the entries.
[[nodiscard]] std::vector<dynamics::NodeDof> dofs_of(const std::vector<const LabelledEntries*>& matrices);

/// The entries by their places in the table (ascending), which must contain all their DOFs.
[[nodiscard]] MatrixEntries in_rows(const LabelledEntries& labelled, const std::vector<dynamics::NodeDof>& dofs);

/// A matrix without zeros. `was_half` is true if the file contained one triangle of it: if the format allows that and
/// no entry has a mirror image, a_ji is set to a_ij.
struct WholeMatrix {
  Eigen::SparseMatrix<double> A;
  bool was_half = false;
};

/// The matrix of these entries. Throws DataError with file and line for an entry that occurs twice. Memory is allocated
/// by matrix.size, which the caller has checked. Cost O(n log n) of the entries.
[[nodiscard]] WholeMatrix whole_matrix(const MatrixEntries& matrix);

}  // namespace thinwall::io

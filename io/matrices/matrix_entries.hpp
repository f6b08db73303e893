#pragma once
// The entries of a matrix as files list them, by row and column or by node and component, before they are a matrix.

#include <Eigen/SparseCore>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "dynamics/sparse_model.hpp"

namespace thinwall::io {

/// Rows, columns and nodes beyond it are refused: they are kept as int, and one more than the last is needed.
inline constexpr std::int64_t largest_label = std::numeric_limits<int>::max() - 1;

/// A number in a file: its row and column, from 0, or two DOFs; and the line that it stands on.
template <class Place>
struct MatrixEntry {
  Place row;
  Place column;
  double value = 0.0;
  int line = 0;
};

/// A square matrix whose rows are numbers.
struct MatrixEntries {
  std::string path;
  int size = 0;
  std::vector<MatrixEntry<int>> entries;
  bool may_be_half = true;  ///< the format allows one triangle of a symmetric matrix
};

/// A matrix whose rows are DOFs, in any order.
struct LabelledEntries {
  std::string path;
  std::string name;  ///< in the file; may be empty
  std::vector<MatrixEntry<dynamics::NodeDof>> entries;
  bool may_be_half = true;  ///< as of MatrixEntries
};

/// The DOFs of all these matrices, each once, by node and component. Cost O(n log n) of the entries.
[[nodiscard]] std::vector<dynamics::NodeDof> dofs_of(const std::vector<const LabelledEntries*>& matrices);

/// The entries by their places in the table (ascending), which must hold them all.
[[nodiscard]] MatrixEntries in_rows(const LabelledEntries& labelled, const std::vector<dynamics::NodeDof>& dofs);

/// The matrix, zeros left out, and whether the file held one triangle of it: where the format allows that and no entry
/// has a mirror image, a_ij is a_ji too.
struct WholeMatrix {
  Eigen::SparseMatrix<double> A;
  bool was_half = false;
};

/// Throws DataError with file and line for an entry that is there twice. Allocates by matrix.size, which the caller has
/// checked. Cost O(n log n) of the entries.
[[nodiscard]] WholeMatrix whole_matrix(const MatrixEntries& matrix);

}  // namespace thinwall::io

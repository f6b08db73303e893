#pragma once
// A matrix of Nastran's exchange files OUTPUT2 and OUTPUT4, which number its rows and do not name them.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/matrices/matrix_entries.hpp"

namespace thinwall::io {

/// One matrix of a file. Entries are read of square matrices (forms 1 and 2, and 6: symmetric) of real numbers (types
/// 1 and 2); others are known by name only.
struct NastranMatrix {
  std::string name;  ///< in capitals
  int form = 0;
  int type = 0;  ///< 1 single, 2 double, 3 and 4 complex
  int rows = 0;
  int columns = 0;
  std::vector<MatrixEntry<int>> entries;  ///< without zeros, by ascending columns and rows; their lines are 0 in bytes
};

/// The matrix that the numbers of a head describe, without entries; nothing if they are those of no matrix.
[[nodiscard]] std::optional<NastranMatrix> described(const std::string& name, std::int64_t columns, std::int64_t rows,
                                                     std::int64_t form, std::int64_t type);

/// True if its entries are read.
[[nodiscard]] bool is_read(const NastranMatrix& matrix);

/// The matrix of that name (matrix_names.hpp) by its rows. Throws DataError if there is none, and for one that is not
/// real and square. `path` is for messages.
[[nodiscard]] MatrixEntries nastran_matrix(const std::vector<NastranMatrix>& matrices, const std::string& wanted,
                                           char letter, const std::string& path);

}  // namespace thinwall::io

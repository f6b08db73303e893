#pragma once
// Matrices in files of Nastran's OUTPUT4, the usual exchange of superelements: text, and bytes of either order.
//
// Layout: MSC Nastran DMAP Programmer's Guide, "OUTPUT4". A matrix is a head (columns, rows, form, type, name) and
// records of its columns, each dense from its first row on or as strings of consecutive rows.

#include <string>
#include <string_view>
#include <vector>

#include "io/matrices/matrix_entries.hpp"

namespace thinwall::io {

/// One matrix of a file. Entries are read of square matrices (forms 1 and 2, and 6: symmetric) of real numbers (types
/// 1 and 2); others are known by name only.
struct Op4Matrix {
  std::string name;  ///< in capitals
  int form = 0;
  int type = 0;  ///< 1 single, 2 double, 3 and 4 complex
  int rows = 0;
  int columns = 0;
  std::vector<MatrixEntry<int>> entries;  ///< without zeros, by ascending columns and rows; their lines are 0 in bytes
};

/// True if the bytes begin with the head of a matrix.
[[nodiscard]] bool is_op4(std::string_view bytes);

/// Reads all matrices: as text with any format of numbers, or as Fortran's records with whole numbers of 4 or 8 bytes;
/// dense, sparse, and sparse with more than 65535 rows ("bigmat"). `path` is for messages. Throws DataError with file
/// and line or byte for a truncated file, columns and rows that do not ascend or lie outside of the matrix, text in
/// place of a number, and one that is not finite. Cost O(bytes).
[[nodiscard]] std::vector<Op4Matrix> read_op4(std::string_view bytes, const std::string& path);

/// The matrix of that name (matrix_names.hpp) by its rows, which the file does not name. Throws DataError if there is
/// none, and for one that is not real and square.
[[nodiscard]] MatrixEntries op4_matrix(const std::vector<Op4Matrix>& matrices, const std::string& wanted, char letter,
                                       const std::string& path);

}  // namespace thinwall::io

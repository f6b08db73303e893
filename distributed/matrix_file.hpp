#pragma once
// A symmetric sparse matrix as a file of which each rank reads its own rows.

#include <cstdint>
#include <filesystem>
#include <vector>

#include "linalg/sparse.hpp"

namespace thinwall::distributed {

/// Some rows of the upper triangle of a symmetric matrix, in compressed rows.
struct UpperRows {
  std::int64_t rows_of_matrix = 0;
  std::vector<int> start;   ///< rows read + 1
  std::vector<int> column;  ///< of the whole matrix, ascending in a row
  std::vector<double> value;
};

/// Writes the upper triangle of A (n × n, both triangles stored, columns sorted): the numbers of rows and entries, the
/// start of each row (64 bits each), the columns (32 bits), the values. Throws DataError if the file cannot be written.
void write_upper_rows(const linalg::SparseMatrix& A, const std::filesystem::path& file);

/// The number of rows of the matrix of a file. Throws DataError if it cannot be read.
[[nodiscard]] std::int64_t rows_of(const std::filesystem::path& file);

/// The rows first … last − 1 of the matrix of a file. Throws DataError if they cannot be read, NumericalError if they
/// have more entries than 32-bit indices count.
[[nodiscard]] UpperRows read_upper_rows(const std::filesystem::path& file, std::int64_t first, std::int64_t last);

}  // namespace thinwall::distributed

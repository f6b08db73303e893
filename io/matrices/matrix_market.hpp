#pragma once
// Matrices in the Matrix Market exchange format (Boisvert, Pozo & Remington 1996, NISTIR 5935).

#include <Eigen/SparseCore>
#include <filesystem>
#include <string>
#include <string_view>

#include "io/matrices/matrix_entries.hpp"

namespace thinwall::io {

/// The entries of a file "%%MatrixMarket matrix coordinate|array real|integer general|symmetric", with rows and columns
/// from 1 in the file; `name` is its name in messages. A symmetric file contains the lower triangle. Throws DataError
/// with file and line for another heading (pattern, complex, hermitian, skew-symmetric), a matrix that is not square,
/// an index beyond its size, a number that is not finite, and fewer or more entries than stated. Counts are checked
/// against the number of bytes before memory is allocated. Cost O(bytes).
[[nodiscard]] MatrixEntries matrix_market_entries(std::string_view bytes, const std::string& name);

/// True if the file begins with the heading of this format.
[[nodiscard]] bool is_matrix_market(std::string_view bytes);

/// Writes the square matrix A with the shortest numbers that are read back exactly: as "symmetric", with the lower
/// triangle, if it is symmetric bit by bit, otherwise as "general". The file is written in one step. Throws
/// NumericalError for a number that is not finite, DataError if the file cannot be written.
void write_matrix_market(const std::filesystem::path& path, const Eigen::SparseMatrix<double>& A);

}  // namespace thinwall::io

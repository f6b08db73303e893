#pragma once
// Matrices in the Matrix Market exchange format (Boisvert, Pozo & Remington 1996, NISTIR 5935).

#include <Eigen/SparseCore>
#include <filesystem>
#include <string>
#include <string_view>

#include "io/matrices/matrix_entries.hpp"

namespace thinwall::io {

/// The bytes of a "%%MatrixMarket matrix coordinate|array real|integer general|symmetric" file, rows and columns from
/// 1; `name` is what messages call it. Of a symmetric file the lower triangle is there. Throws DataError with file and
/// line: another heading (pattern, complex, hermitian, skew-symmetric), a matrix that is not square, an index beyond
/// it, a number that is not finite, fewer or more entries than stated. No count is believed beyond the bytes that are
/// there. Cost O(bytes).
[[nodiscard]] MatrixEntries matrix_market_entries(std::string_view bytes, const std::string& name);

/// True if the file begins as one of this format does.
[[nodiscard]] bool is_matrix_market(std::string_view bytes);

/// Writes A, square, with the shortest numbers that read back as the same: "symmetric", the lower triangle, if it is so
/// bit by bit, else "general". Written in one step. Throws NumericalError for a number that is not finite, DataError if
/// the file cannot be written.
void write_matrix_market(const std::filesystem::path& path, const Eigen::SparseMatrix<double>& A);

}  // namespace thinwall::io

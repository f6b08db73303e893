#pragma once
// A sparse matrix in PETSc's binary format, for the peers.

#include <bit>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "linalg/sparse.hpp"

namespace thinwall::bench {

namespace petsc_detail {

template <typename Integer>
void append_big_endian(std::string& bytes, Integer value) {
  for (int shift = 8 * static_cast<int>(sizeof(Integer)) - 8; shift >= 0; shift -= 8) {
    bytes.push_back(static_cast<char>((value >> shift) & 0xff));
  }
}

}  // namespace petsc_detail

/// Writes a symmetric A (both triangles stored, so that its columns are its rows) as PETSc's MatLoad reads it: class id
/// 1211216, rows, columns, entries, entries of each row, column indices, values; 32-bit integers and doubles, big
/// endian. Throws InputError beyond 2³¹ − 1 entries, DataError if the file cannot be written.
inline void write_petsc(const std::filesystem::path& path, const linalg::SparseMatrix& A) {
  using petsc_detail::append_big_endian;
  if (A.nonZeros() > std::numeric_limits<std::int32_t>::max()) {
    throw core::InputError("PETSc with 32-bit indices holds no " + std::to_string(A.nonZeros()) + " entries");
  }
  const auto word = [](auto value) { return static_cast<std::uint32_t>(value); };
  std::string bytes;
  bytes.reserve(static_cast<std::size_t>(16 + 4 * A.rows() + 12 * A.nonZeros()));
  for (const auto value : {Eigen::Index{1211216}, A.rows(), A.cols(), A.nonZeros()})
    append_big_endian(bytes, word(value));
  for (Eigen::Index row = 0; row < A.cols(); ++row) {
    append_big_endian(bytes, word(A.outerIndexPtr()[row + 1] - A.outerIndexPtr()[row]));
  }
  for (Eigen::Index k = 0; k < A.nonZeros(); ++k) append_big_endian(bytes, word(A.innerIndexPtr()[k]));
  for (Eigen::Index k = 0; k < A.nonZeros(); ++k) {
    append_big_endian(bytes, std::bit_cast<std::uint64_t>(A.valuePtr()[k]));
  }
  core::write_file_atomically(path, bytes);
}

}  // namespace thinwall::bench

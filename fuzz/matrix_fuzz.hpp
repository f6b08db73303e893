#pragma once
// Bytes as a matrix: nothing but our own errors may leave the reader, and what is read can be assembled.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/error.hpp"
#include "io/matrices/matrix_entries.hpp"

namespace thinwall::fuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Assembles entries by row; a stated size alone makes no memory, so that large ones are left.
inline void assemble(const io::MatrixEntries& matrix) {
  for (const auto& entry : matrix.entries)
    if (entry.row < 0 || entry.column < 0 || entry.row >= matrix.size || entry.column >= matrix.size) std::abort();
  if (matrix.size <= 100000) static_cast<void>(io::whole_matrix(matrix));
}

inline void assemble(const io::LabelledEntries& labelled) {
  assemble(io::in_rows(labelled, io::dofs_of({&labelled})));
}

/// Calls `read(text)`; a DataError refuses the bytes, anything else that is thrown is a fault.
template <class Read>
int read_matrix_bytes(const std::uint8_t* data, std::size_t size, Read read) {
  try {
    read(text_of(data, size));
  } catch (const core::DataError&) {
    return 0;
  }
  return 0;
}

}  // namespace thinwall::fuzz

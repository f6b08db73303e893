#pragma once
// Matrices in files of Nastran's OUTPUT4, the usual exchange of superelements: text, and bytes of either order.
//
// Layout: MSC Nastran DMAP Programmer's Guide, "OUTPUT4". A matrix is a head (columns, rows, form, type, name) and
// records of its columns, each dense from its first row on or as strings of consecutive rows.

#include <string>
#include <string_view>
#include <vector>

#include "io/matrices/nastran_matrix.hpp"

namespace thinwall::io {

/// True if the bytes begin with the head of a matrix.
[[nodiscard]] bool is_op4(std::string_view bytes);

/// Reads all matrices: as text with any format of numbers, or as Fortran's records with whole numbers of 4 or 8 bytes;
/// dense, sparse, and sparse with more than 65535 rows ("bigmat"). `path` is for messages. Throws DataError with file
/// and line or byte for a truncated file, columns and rows that do not ascend or lie outside of the matrix, text in
/// place of a number, and one that is not finite. Cost O(bytes).
[[nodiscard]] std::vector<NastranMatrix> read_op4(std::string_view bytes, const std::string& path);

}  // namespace thinwall::io

#pragma once
// Matrices in files of Nastran's OUTPUT2: Fortran's records, of either byte order and with words of 4 or 8 bytes.
//
// Layout: MSC Nastran DMAP Programmer's Guide, "OUTPUT2". Between the records with data stand keys, records of one
// word: the words of the data that follow, or a number at or below zero that ends a group. A file may begin with a
// label: 3, the date, 7, a title, 2, the label, −1, 0. A data block is
//
//     2, name; −1; n, trailer: number, columns, rows, form, type …; −2, 1, 0; n, header;
//     then −3, −4 … and 1, each time with 1 and the strings of one column, or with 0 and records of a table;
//     a last number, 1, 0; 0.
//
// The string of a column is a key and a record of its first row and numbers from there on.

#include <string>
#include <string_view>
#include <vector>

#include "io/matrices/nastran_matrix.hpp"

namespace thinwall::io {

/// True if the bytes begin with the records of a label or of a data block's name.
[[nodiscard]] bool is_op2(std::string_view bytes);

/// Reads all matrices; tables, and with them matrices as tables of DMIG (DMIGOP2), are passed over. `path` is for
/// messages. Throws DataError with file and byte for a truncated file, columns or rows that do not ascend or lie
/// outside of the matrix, and a number that is not finite; for a file without a matrix with the names of its tables.
/// Cost O(bytes).
[[nodiscard]] std::vector<NastranMatrix> read_op2(std::string_view bytes, const std::string& path);

}  // namespace thinwall::io

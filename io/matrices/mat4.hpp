#pragma once
// MAT files of version 4, which old MATLAB programs and measuring systems write, and SciPy on request.
//
// Layout: The MathWorks, "MAT-File Format", "Level 4 MAT-Files": a head of five whole numbers, the name, and the
// numbers column by column.

#include <string>
#include <string_view>
#include <vector>

#include "io/matrices/mat_variables.hpp"

namespace thinwall::io {

/// True if the bytes begin with the head of a variable of version 4.
[[nodiscard]] bool is_mat4(std::string_view bytes);

/// The named variables that the file contains: full arrays of any of its six kinds of numbers, and real sparse
/// matrices. `path` is for messages. Throws DataError that names the file, and the variable if it is a text, complex
/// and sparse, holds NaN or infinity, or an entry beyond its rows; for a truncated file, one in the number format of a
/// VAX or a Cray, and a sparse matrix with more than 64 rows or columns for each byte of the file. Cost O(bytes).
[[nodiscard]] MatVariables mat4_variables(std::string_view bytes, const std::vector<std::string>& names,
                                          const std::string& path);

}  // namespace thinwall::io

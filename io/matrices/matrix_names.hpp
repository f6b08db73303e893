#pragma once
// The choice of one matrix of a file that holds several.

#include <cstddef>
#include <string>
#include <vector>

namespace thinwall::io {

/// The index of the matrix with the wanted name, in any case of its letters; if it is empty, of the one whose name
/// begins with the letter, but not with K4 (structural damping). Throws DataError that lists the names if there is none
/// or more than one. `path` is for messages.
[[nodiscard]] std::size_t matrix_by_name(const std::vector<std::string>& names, const std::string& wanted, char letter,
                                         const std::string& path);

}  // namespace thinwall::io

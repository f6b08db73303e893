#pragma once
// The layout of a MAT file of version 5, which is checked before matio reads the file.

#include <cstddef>
#include <filesystem>
#include <string>

namespace thinwall::io {

/// Checks the lengths of all elements of the file, because matio reads a variable whose end is missing as if its last
/// entries were zero. An element is a tag (type, bytes) and its data, in whole words of 8 bytes unless they are
/// compressed. Returns the largest number of bytes that a variable can have. Throws DataError with the path for a file
/// that is not whole, or has a variable that states more than its bytes can hold.
[[nodiscard]] std::size_t require_whole_mat5(const std::string& bytes, const std::filesystem::path& path);

}  // namespace thinwall::io

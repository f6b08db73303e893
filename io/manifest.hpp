#pragma once
// The manifest of a result, which lists the files that it consists of and was made from, with their SHA-256.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace thinwall::io {

/// One file, with its name relative to its folder and '/' between the parts.
struct FileRecord {
  std::string name;
  std::uintmax_t bytes = 0;
  std::string sha256;
};

/// SHA-256 (FIPS 180-4) of the bytes, as 64 lower-case hexadecimal digits.
[[nodiscard]] std::string sha256(std::string_view bytes);

/// SHA-256 of a file, read in pieces. Throws DataError if it cannot be read.
[[nodiscard]] std::string sha256_of_file(const std::filesystem::path& path);

/// Every plain file below `folder`, sorted by name, without unfinished ones (core::is_partial_name()). Files are hashed
/// in parallel. Throws DataError if the folder or a file cannot be read.
[[nodiscard]] std::vector<FileRecord> file_records(const std::filesystem::path& folder);

}  // namespace thinwall::io

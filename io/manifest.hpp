#pragma once
// The manifest of a result, which lists what it was made from and consists of: files with their SHA-256.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace thinwall::io {

/// One file, named relative to its folder with '/' between the parts.
struct FileRecord {
  std::string name;
  std::uintmax_t bytes = 0;
  std::string sha256;
};

/// SHA-256 (FIPS 180-4) of the bytes, as 64 lower-case hexadecimal digits.
[[nodiscard]] std::string sha256(std::string_view bytes);

/// SHA-256 of a file, read in pieces. Throws DataError if it cannot be read.
[[nodiscard]] std::string sha256_of_file(const std::filesystem::path& path);

/// Every plain file below `folder`, by rising name, without unfinished ones (core::is_partial_name). Throws DataError
/// if the folder or a file cannot be read. Files are hashed side by side.
[[nodiscard]] std::vector<FileRecord> file_records(const std::filesystem::path& folder);

}  // namespace thinwall::io

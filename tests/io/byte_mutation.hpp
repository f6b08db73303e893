#pragma once
// Files changed at random, the same for the same generator.

#include <algorithm>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "core/atomic_file.hpp"

namespace thinwall::io::test {

/// The files of fuzz/corpus/FORMAT in the order of their names.
inline std::vector<std::string> corpus_of(const std::string& format) {
  std::vector<std::filesystem::path> paths;
  const auto folder = std::filesystem::path(THINWALL_SOURCE_DIR) / "fuzz" / "corpus" / format;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> files;
  for (const auto& path : paths) files.push_back(core::read_file(path));
  return files;
}

/// One to eight bytes changed, digits into digits, a piece cut out or doubled, or the end cut off.
inline std::string mutated(std::string bytes, std::mt19937& random) {
  const auto below = [&random](std::size_t bound) { return random() % std::max<std::size_t>(bound, 1); };
  switch (below(6)) {
    case 0:
      return bytes.substr(0, below(bytes.size()));
    case 1:
      return bytes.erase(below(bytes.size()), 1 + below(60));
    case 2:
      return bytes.insert(below(bytes.size()), bytes.substr(below(bytes.size()), 1 + below(100)));
    case 3:
    case 4:
      for (std::size_t k = 0; k < 100; ++k) {
        char& c = bytes[below(bytes.size())];
        if (c >= '0' && c <= '9') c = static_cast<char>('0' + below(10));
      }
      return bytes;
    default:
      for (std::size_t k = 0; k <= below(8); ++k) bytes[below(bytes.size())] = static_cast<char>(below(256));
      return bytes;
  }
}

}  // namespace thinwall::io::test

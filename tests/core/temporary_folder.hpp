#pragma once
// A folder that goes with the test.

#include <cstdlib>
#include <filesystem>
#include <string>

namespace thinwall::tests {

struct TemporaryFolder {
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "thinwall-XXXXXX").string();
    path = ::mkdtemp(pattern.data());
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path path;
};

/// The folder of this process's temporary files, which goes with it: two processes share no name.
inline const std::filesystem::path& temporary_files() {
  static const TemporaryFolder folder;
  return folder.path;
}

}  // namespace thinwall::tests

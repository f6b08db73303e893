#pragma once
// The lock by which one process at a time writes into a folder.

#include <filesystem>
#include <optional>

namespace thinwall::report {

/// An advisory lock (flock) on a folder itself, for as long as the object lives: it goes with the process, however that
/// ends, and leaves no file behind. It follows the folder when that is renamed.
class FolderLock {
 public:
  /// Holds nothing.
  FolderLock() = default;

  /// The lock of the folder at this path; empty if another process has it, or if another folder came to the path
  /// meanwhile. Throws DataError if there is no folder or it knows no locks.
  [[nodiscard]] static std::optional<FolderLock> of(const std::filesystem::path& folder);

  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;

 private:
  explicit FolderLock(int descriptor) : descriptor_(descriptor) {}

  int descriptor_ = -1;
};

}  // namespace thinwall::report

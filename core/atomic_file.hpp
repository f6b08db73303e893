#pragma once
// Writing of files in one step: a reader finds the complete new file or the earlier one, never a part.

#include <filesystem>
#include <string>
#include <string_view>

namespace thinwall::core {

/// A file under construction: write to `partial()`, then call `commit()`. The partial file lies beside the target, so
/// that the final rename stays within one file system; it is removed if commit() is never reached (an error, an
/// interruption). The class serves writers that insist on a path of their own (VTK, HDF5); for text,
/// write_file_atomically() is shorter. The partial file keeps the target's extension, because some writers choose their
/// format by it.
class PartialFile {
 public:
  /// Throws DataError if the folder does not exist or the target is something else than a plain file.
  explicit PartialFile(std::filesystem::path target);
  ~PartialFile();
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  /// The file to write to until commit().
  [[nodiscard]] const std::filesystem::path& partial() const { return partial_; }

  /// Flushes the partial file to the disk (fsync) and renames it to the target. Throws DataError with the cause.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path partial_;
};

/// A name in the folder of `target` for an unfinished file or folder: is_partial_name() recognises it, and it contains
/// the process number and a counter, so that no other writer uses it.
[[nodiscard]] std::filesystem::path partial_path(const std::filesystem::path& target);

/// True for the names that PartialFile gives to unfinished files, so that the leftovers of a killed run can be
/// recognised and removed.
[[nodiscard]] bool is_partial_name(const std::filesystem::path& path);

/// True for a name that partial_path() gives for this target.
[[nodiscard]] bool is_partial_name_of(const std::filesystem::path& path, const std::filesystem::path& target);

/// Removes every file and folder that this process has under a name of partial_path() and has not renamed. It serves
/// a process that ends at once, whose destructors will not run; other threads may be writing meanwhile. Throws nothing.
void remove_partial_paths() noexcept;

/// Writes `content` to `path`, replacing an earlier file in one step: a reader sees the old file or the new one, never
/// a part. Throws DataError (full disk, read-only folder, missing folder) and then leaves the earlier file as it was.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

/// The content of the whole file as bytes. Throws DataError with the cause if it is a folder, a pipe or a device, or
/// cannot be read.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

}  // namespace thinwall::core

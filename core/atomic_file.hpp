#pragma once
// Files that appear whole or not at all.

#include <filesystem>
#include <string>
#include <string_view>

namespace thinwall::core {

/// A file under construction: write to `partial()`, then `commit()`. The partial file lies beside the target, so that
/// the final rename stays within one file system; it is removed if commit() is never reached (an error, an
/// interruption). For writers that insist on a path of their own (VTK, HDF5); write_file_atomically() is the short form
/// for text. The target's extension is kept, because some writers choose their format by it.
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

/// A name beside `target` that is_partial_name() knows and nobody else uses, for an unfinished file or folder.
[[nodiscard]] std::filesystem::path partial_path(const std::filesystem::path& target);

/// True for the names that PartialFile gives to unfinished files: leftovers of a killed run can be told and removed.
[[nodiscard]] bool is_partial_name(const std::filesystem::path& path);

/// Writes `content` to `path`, replacing an earlier file in one step: a reader sees the old file or the new one, never
/// a part. Throws DataError (full disk, read-only folder, missing folder) and then leaves the earlier file as it was.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

/// The whole file as bytes; throws DataError with the cause.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

}  // namespace thinwall::core

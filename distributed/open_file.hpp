#pragma once
// A file whose pieces are read and written at given places, by several processes.

#include <cstddef>
#include <filesystem>

namespace thinwall::distributed {

/// A file that is open as long as the object lives. Opened after another process has closed it, it shows what that
/// process wrote, on a network file system too.
class OpenFile {
 public:
  /// The use that is made of the file.
  enum class Access { read, write };

  /// Opens the file; for writing it is made if it is not there. Throws DataError.
  OpenFile(const std::filesystem::path& file, Access access);
  ~OpenFile();
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  /// Reads `bytes` bytes from a place of the file. Throws DataError if there are fewer.
  void read(void* to, std::size_t bytes, std::size_t place) const;
  /// Writes `bytes` bytes to a place of the file. Throws DataError, as for a full disk.
  void write(const void* from, std::size_t bytes, std::size_t place) const;
  /// Closes the file after the last write. Throws DataError: a network file system tells of a full disk only now.
  void finish();

 private:
  std::filesystem::path name_;
  int file_ = -1;
};

}  // namespace thinwall::distributed

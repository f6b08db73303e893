#pragma once
// Fortran's unformatted records in a file's bytes: the length in 4 bytes, the data, the length again.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace thinwall::io {

/// True if a record of so many bytes begins at a byte and ends where it should.
[[nodiscard]] bool is_record(std::string_view bytes, std::size_t at, std::int32_t length, bool big_endian);

/// A reader of records, one after the other. Each call reads on, and throws DataError with file and byte if something
/// else stands there or the file ends.
class FortranRecords {
 public:
  /// Largest whole number that is accepted, so that sums of a few of them do not overflow.
  static constexpr std::int64_t most = std::int64_t{1} << 50;

  /// The bytes must outlive it; `path` is for messages; `wide`: words are of 8 bytes instead of 4.
  FortranRecords(std::string_view bytes, std::string path, bool big_endian, bool wide);

  /// True after the last record.
  [[nodiscard]] bool at_end() const { return at_ == bytes_.size(); }
  /// Enters the next record.
  void open();
  /// Leaves a record of which something may be unread.
  void close() { at_ = end_ + 4; }
  /// Bytes of the record that are unread.
  [[nodiscard]] std::size_t left() const { return end_ - at_; }
  /// Bytes of a word.
  [[nodiscard]] std::size_t word() const { return wide_ ? 8 : 4; }
  /// One whole number of a word.
  [[nodiscard]] std::int64_t whole();
  /// So many characters as they are.
  [[nodiscard]] std::string_view text(std::size_t count);
  /// Reads so many finite numbers into `values`: of single precision in 4 bytes, else in 8.
  void numbers(std::int64_t count, bool single, std::vector<double>& values);
  /// Throws DataError with the byte.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::string_view bytes_;
  std::string path_;
  std::size_t at_ = 0;
  std::size_t end_ = 0;  ///< of the data of the record
  bool big_endian_ = false;
  bool wide_ = false;
};

}  // namespace thinwall::io

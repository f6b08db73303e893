#pragma once
// The parts of an OUTPUT4 file, one after the other: as text and as Fortran's records of bytes.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/matrices/fortran_records.hpp"

namespace thinwall::io {

/// The head of a matrix. Fewer rows than none say that its strings are those of a large matrix.
struct Op4Head {
  std::int64_t columns = 0;
  std::int64_t rows = 0;
  std::int64_t form = 0;
  std::int64_t type = 0;
  std::string name;
};

/// The head of a column: its number; the row at which its numbers begin, or 0 if they come in strings; their words. The
/// last one of a matrix lies beyond its columns.
struct Op4Column {
  std::int64_t column = 0;
  std::int64_t row = 0;
  std::int64_t words = 0;
};

/// The head of a string: its first row, and its words without the head.
struct Op4String {
  std::int64_t row = 0;
  std::int64_t words = 0;
};

/// The string whose head is the one number (words + 1) 65536 + row.
[[nodiscard]] inline Op4String op4_string(std::int64_t head) {
  return {head % 65536, head / 65536 - 1};
}

/// A reader of text: numbers in fields whose width and count in a line the head of a matrix states. Each call reads on;
/// each throws DataError with the line if what stands there is something else, or the file ends.
class Op4Text {
 public:
  /// The bytes must outlive it; `path` is for messages.
  Op4Text(std::string_view bytes, std::string path) : rest_(bytes), path_(std::move(path)) {}

  /// The head of the next matrix; nothing at the end of the file.
  [[nodiscard]] std::optional<Op4Head> head();
  /// The head of the next column.
  [[nodiscard]] Op4Column column();
  /// The head of the next string of a column; `large`: it is two numbers instead of one.
  [[nodiscard]] Op4String string(bool large);
  /// Reads so many numbers into `values`.
  void numbers(std::int64_t count, std::vector<double>& values);
  /// Leaves the column.
  void end_column() {}
  /// Leaves the column beyond the last one.
  void end_matrix();
  /// The words of a number of double precision.
  [[nodiscard]] static int words_of_double() { return 2; }
  /// The numbers of a dense column that states so many words: as text it counts numbers.
  [[nodiscard]] static std::int64_t dense_numbers(std::int64_t words, int /*words_of_number*/) { return words; }
  /// The line, or 0 in bytes.
  [[nodiscard]] int line() const { return line_; }
  /// Throws DataError with the place.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  std::string_view next_line();
  [[nodiscard]] std::int64_t whole(std::string_view text) const;
  void read_format(std::string_view text);

  std::string_view rest_;
  std::string path_;
  int line_ = 0;
  std::size_t in_a_line_ = 5;
  std::size_t width_ = 16;
};

/// A reader of Fortran's records. Its calls are those of Op4Text, and throw DataError with the byte.
class Op4Bytes {
 public:
  /// The bytes must outlive it; `path` is for messages.
  Op4Bytes(std::string_view bytes, std::string path);

  /// True if the bytes begin with the record of a head.
  [[nodiscard]] static bool begins(std::string_view bytes);

  /// The head of the next matrix; nothing at the end of the file.
  [[nodiscard]] std::optional<Op4Head> head();
  /// The head of the next column.
  [[nodiscard]] Op4Column column();
  /// The head of the next string of a column; `large`: it is two numbers instead of one.
  [[nodiscard]] Op4String string(bool large);
  /// Reads so many numbers into `values`.
  void numbers(std::int64_t count, std::vector<double>& values);
  /// Leaves the record of the column.
  void end_column();
  /// Leaves the record of the column beyond the last one.
  void end_matrix() { records_.close(); }
  /// The words of a number of double precision.
  [[nodiscard]] int words_of_double() const { return records_.word() == 8 ? 1 : 2; }
  /// The numbers of a dense column that states so many words.
  [[nodiscard]] static std::int64_t dense_numbers(std::int64_t words, int words_of_number) {
    return words / words_of_number;
  }
  /// No line: bytes have none.
  [[nodiscard]] static int line() { return 0; }
  /// Throws DataError with the byte.
  [[noreturn]] void fail(const std::string& what) const { records_.fail(what); }

 private:
  FortranRecords records_;
  bool single_ = false;  ///< the matrix is of single precision
};

/// True if the text begins with the head of a matrix.
[[nodiscard]] bool is_op4_text(std::string_view bytes);

}  // namespace thinwall::io

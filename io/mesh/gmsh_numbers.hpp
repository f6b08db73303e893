#pragma once
// The numbers of an MSH file, whether they are written as text or as bytes.

#include <cstdint>
#include <string>
#include <string_view>

#include "io/surface_text.hpp"

namespace thinwall::io {

/// Goes through a file number by number. The bytes must outlive it. Throws DataError with file and line (text), or file
/// and byte, where the file ends early or holds something else.
class GmshNumbers {
 public:
  GmshNumbers(std::string_view bytes, std::string name);

  /// Text between numbers: section names and the counts of MSH 2, in binary files, too.
  [[nodiscard]] SurfaceText& text() { return text_; }

  /// From here on numbers are bytes; they begin with the number 1, which tells their order.
  void begin_binary();
  /// True if numbers are bytes by now.
  [[nodiscard]] bool is_binary() const { return is_binary_; }

  /// An integer of four bytes, a count or a number of eight bytes, a real of eight bytes; as text a word each.
  [[nodiscard]] std::int64_t integer(const char* what, std::int64_t least, std::int64_t most);
  /// See integer().
  [[nodiscard]] std::int64_t count(const char* what, std::int64_t least, std::int64_t most);
  /// See integer().
  [[nodiscard]] double real(const char* what);

  /// The line, 0 in binary files.
  [[nodiscard]] std::int64_t line() const { return is_binary_ ? 0 : text_.line(); }
  /// Throws DataError with the file, its line or byte, and what.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  template <class T>
  T taken(const char* what);
  std::int64_t within(std::int64_t value, const char* what, std::int64_t least, std::int64_t most) const;

  std::string name_;
  std::size_t size_;
  SurfaceText text_;
  bool is_binary_ = false;
  bool is_turned_ = false;
};

}  // namespace thinwall::io

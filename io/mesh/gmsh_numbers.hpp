#pragma once
// The numbers of an MSH file in text or binary form.

#include <cstdint>
#include <string>
#include <string_view>

#include "io/surface_text.hpp"

namespace thinwall::io {

/// A reader of a file number by number. The bytes must outlive it. Throws DataError with file and line (text), or file
/// and byte, if the file ends early or contains anything else.
class GmshNumbers {
 public:
  GmshNumbers(std::string_view bytes, std::string name);

  /// The text between numbers: section names and the counts of MSH 2, in binary files too.
  [[nodiscard]] SurfaceText& text() { return text_; }

  /// Changes to binary numbers, which begin with the number 1 that shows their byte order.
  void begin_binary();
  /// True if numbers are read in binary form.
  [[nodiscard]] bool is_binary() const { return is_binary_; }

  /// The next integer, of four bytes in binary form, from `least` to `most`; `what` names it in messages.
  [[nodiscard]] std::int64_t integer(const char* what, std::int64_t least, std::int64_t most);
  /// The next count or label, of eight bytes in binary form, from `least` to `most`.
  [[nodiscard]] std::int64_t count(const char* what, std::int64_t least, std::int64_t most);
  /// The next real number, of eight bytes in binary form.
  [[nodiscard]] double real(const char* what);

  /// The number of the line, 0 in binary form.
  [[nodiscard]] std::int64_t line() const { return is_binary_ ? 0 : text_.line(); }
  /// Throws DataError with the file, its line or byte, and `what`.
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

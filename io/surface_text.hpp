#pragma once
// The text formats of surfaces and meshes (STL, OFF, OBJ, PLY, MSH, VTU) as words, numbers and lines.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace thinwall::io {

/// A reader of a text word by word; anything from `comment` to the end of a line is skipped. '.' is the decimal sign
/// whatever the locale. The bytes must outlive it. The cost of a call is proportional to the bytes that it passes.
class SurfaceText {
 public:
  /// A reader of these bytes; `comment` '\0': there are no comments. `name` is the file's name in messages.
  SurfaceText(std::string_view bytes, std::string name, char comment);

  /// The next word, on this line or a later one; empty at the end of the text.
  [[nodiscard]] std::string_view word();
  /// The next word of this line; empty at its end.
  [[nodiscard]] std::string_view word_of_line();
  /// Skips the rest of this line.
  void skip_line();
  /// The next `count` bytes of any kind, or all that are left if there are fewer.
  [[nodiscard]] std::string_view take(std::size_t count);
  /// True if only blanks and comments are left.
  [[nodiscard]] bool at_end();

  /// The next word as a finite number; `what` names it in the message. Throws DataError with file and line.
  [[nodiscard]] double number(const char* what);
  /// The next word as a whole number from `least` to `most`. Throws DataError with file and line.
  [[nodiscard]] std::int64_t whole_number(const char* what, std::int64_t least, std::int64_t most);
  /// The given word as a finite number. Throws as number() does.
  [[nodiscard]] double number(std::string_view word, const char* what) const;
  /// The given word as a whole number from `least` to `most`. Throws as whole_number() does.
  [[nodiscard]] std::int64_t whole_number(std::string_view word, const char* what, std::int64_t least,
                                          std::int64_t most) const;

  /// Number of bytes that are left, against which counts in a file are checked.
  [[nodiscard]] std::size_t bytes_left() const { return rest_.size(); }
  /// The text that is left.
  [[nodiscard]] std::string_view rest() const { return rest_; }
  /// Number of the line, from 1.
  [[nodiscard]] int line() const { return line_; }

  /// Throws DataError such as "part.off:12: what".
  [[noreturn]] void fail(const std::string& what) const;

 private:
  void skip_blanks(bool also_line_ends);

  std::string_view rest_;
  std::string name_;
  char comment_;
  int line_ = 1;
};

/// Largest count or number in these files, because they are stored as int.
inline constexpr std::int64_t largest_int = std::numeric_limits<int>::max();

/// The word in quotes for a message: at most 40 characters, with '?' for those that cannot be printed.
[[nodiscard]] std::string quoted(std::string_view word);

/// The word with A…Z as a…z, because keywords of these formats do not depend on case.
[[nodiscard]] std::string lower_case(std::string_view word);

}  // namespace thinwall::io

#pragma once
// The text formats of surfaces and meshes (STL, OFF, OBJ, PLY, MSH, VTU) below the level of meaning: words, numbers,
// lines.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace thinwall::io {

/// Goes through a text word by word; what stands after `comment` to the end of a line is passed over. '.' is the
/// decimal sign whatever the locale. The bytes must outlive it. Every call costs the bytes that it passes.
class SurfaceText {
 public:
  /// `comment` '\0': there are none. `name` is what messages call the file.
  SurfaceText(std::string_view bytes, std::string name, char comment);

  /// The next word, on this line or a later one; empty at the end of the text.
  [[nodiscard]] std::string_view word();
  /// The next word of this line; empty at its end.
  [[nodiscard]] std::string_view word_of_line();
  /// Passes over the rest of this line.
  void skip_line();
  /// The next `count` bytes, whatever they are; all that is left if there are fewer.
  [[nodiscard]] std::string_view take(std::size_t count);
  /// True if nothing but blanks and comments is left.
  [[nodiscard]] bool at_end();

  /// The next word as a finite number; `what` names it in the message. Throws DataError with file and line.
  [[nodiscard]] double number(const char* what);
  /// The next word as a whole number from `least` to `most`. Throws DataError with file and line.
  [[nodiscard]] std::int64_t whole_number(const char* what, std::int64_t least, std::int64_t most);
  /// Converts a word at hand; otherwise as the function above.
  [[nodiscard]] double number(std::string_view word, const char* what) const;
  /// Converts a word at hand; otherwise as the function above.
  [[nodiscard]] std::int64_t whole_number(std::string_view word, const char* what, std::int64_t least,
                                          std::int64_t most) const;

  /// Bytes that are not yet passed: no count in a file is believed beyond them.
  [[nodiscard]] std::size_t bytes_left() const { return rest_.size(); }
  /// The text that is not yet passed.
  [[nodiscard]] std::string_view rest() const { return rest_; }
  /// Number of the line, from 1.
  [[nodiscard]] int line() const { return line_; }

  /// Throws DataError "part.off:12: what".
  [[noreturn]] void fail(const std::string& what) const;

 private:
  void skip_blanks(bool also_line_ends);

  std::string_view rest_;
  std::string name_;
  char comment_;
  int line_ = 1;
};

/// Counts and numbers of these files are kept as int.
inline constexpr std::int64_t largest_int = std::numeric_limits<int>::max();

/// The word in quotes for a message: at most 40 characters, anything that does not print as '?'.
[[nodiscard]] std::string quoted(std::string_view word);

/// a…z for A…Z: keywords of these formats do not depend on case.
[[nodiscard]] std::string lower_case(std::string_view word);

}  // namespace thinwall::io

#pragma once
// A message as one line that a terminal can show.

#include <string>

namespace thinwall::core {

/// The text as a terminal can show it: "?" stands for each control character but the tab, since they would end the
/// line, move the cursor or worse, for each character without a width that turns the direction of the text (U+202E),
/// joins or divides it, and for each byte that is no UTF-8.
[[nodiscard]] std::string printable_text(const std::string& text);

/// The message in one line of printable text. Of a message of more than 600 bytes, which repeats a value that no case
/// has, the head and the tail stay, where the place and the remedy are, with "…" between them.
[[nodiscard]] std::string message_line(std::string text);

}  // namespace thinwall::core

#pragma once
// A message as one line that a terminal can show.

#include <string>

namespace thinwall::core {

/// The message in one line. Control characters stand in it as "?", since they would end the line, move the cursor or
/// worse; tabs stay. Of a message of more than 600 bytes, which repeats a value that no case has, the head and the tail
/// stay, where the place and the remedy are, with "…" between them.
[[nodiscard]] std::string message_line(std::string text);

}  // namespace thinwall::core

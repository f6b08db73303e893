#include "core/message_line.hpp"

namespace thinwall::core {

namespace {

constexpr std::size_t longest = 600, longest_head = 350, longest_tail = 200;

/// True of a byte within a character of UTF-8, before which no text is cut.
bool continues_character(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

bool is_control(char byte) {
  const auto code = static_cast<unsigned char>(byte);
  return (code < 0x20 && byte != '\t') || code == 0x7f;
}

/// The code point of a character of two or three bytes that is whole; of others 0.
unsigned code_point(const std::string& text, std::size_t at, std::size_t length) {
  const auto bits = [&](std::size_t i) { return static_cast<unsigned char>(text[at + i]) & 0x3FU; };
  if (length == 2) return ((bits(0) & 0x1FU) << 6U) | bits(1);
  return length == 3 ? ((bits(0) & 0x0FU) << 12U) | (bits(1) << 6U) | bits(2) : 0;
}

/// True of control characters beyond ASCII, and of characters without a width that turn the direction of a text, join
/// or divide it, or end a line.
bool is_unseen(unsigned code) {
  return (code >= 0x80 && code <= 0x9F) || code == 0xAD || code == 0x61C || (code >= 0x200B && code <= 0x200F) ||
         (code >= 0x2028 && code <= 0x202E) || (code >= 0x2060 && code <= 0x206F) || code == 0xFEFF;
}

/// The number of bytes of the character that begins at `at`, by the first of them; 1 where it is cut short or begins
/// with a byte that no character begins with.
std::size_t character_length(const std::string& text, std::size_t at) {
  const auto first = static_cast<unsigned char>(text[at]);
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : first >= 0xC2 ? 2 : 1;
  if (first >= 0xF5 || at + length > text.size()) return 1;
  for (std::size_t i = 1; i < length; ++i)
    if (!continues_character(text[at + i])) return 1;
  return length;
}

}  // namespace

std::string printable_text(const std::string& text) {
  std::string shown;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = character_length(text, at);
    const bool single = length == 1 && (is_control(text[at]) || static_cast<unsigned char>(text[at]) >= 0x80);
    if (single || is_unseen(code_point(text, at, length))) {
      shown += '?';
    } else {
      shown.append(text, at, length);
    }
    at += length;
  }
  return shown;
}

std::string message_line(std::string text) {
  text = printable_text(text);
  if (text.size() <= longest) return text;
  std::size_t head = longest_head, tail = text.size() - longest_tail;
  while (head > 0 && continues_character(text[head])) --head;
  while (tail < text.size() && continues_character(text[tail])) ++tail;
  return text.substr(0, head) + " … " + text.substr(tail);
}

}  // namespace thinwall::core

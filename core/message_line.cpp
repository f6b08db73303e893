#include "core/message_line.hpp"

#include <algorithm>

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

}  // namespace

std::string message_line(std::string text) {
  std::ranges::replace_if(text, is_control, '?');
  if (text.size() <= longest) return text;
  std::size_t head = longest_head, tail = text.size() - longest_tail;
  while (head > 0 && continues_character(text[head])) --head;
  while (tail < text.size() && continues_character(text[tail])) ++tail;
  return text.substr(0, head) + " … " + text.substr(tail);
}

}  // namespace thinwall::core

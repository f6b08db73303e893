#include "core/message_line.hpp"

#include <algorithm>
#include <array>
#include <string_view>

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

/// True of a character that a terminal does not show but obeys: the control characters from U+0080 to U+009F, and those
/// that turn the direction of the text behind them (Unicode Standard Annex 9, tables 1 and 2).
bool is_obeyed(std::string_view character) {
  constexpr std::array<std::string_view, 12> directions{"\u061c", "\u200e", "\u200f", "\u202a", "\u202b", "\u202c",
                                                        "\u202d", "\u202e", "\u2066", "\u2067", "\u2068", "\u2069"};
  const bool second_control = character.size() == 2 && character >= "\u0080" && character <= "\u009f";
  return second_control || std::ranges::find(directions, character) != directions.end();
}

}  // namespace

std::string printable_text(const std::string& text) {
  std::string shown;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = character_length(text, at);
    const bool is_bad_byte = length == 1 && (is_control(text[at]) || static_cast<unsigned char>(text[at]) >= 0x80);
    const std::string_view character = std::string_view(text).substr(at, length);
    shown += is_bad_byte || is_obeyed(character) ? "?" : character;
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

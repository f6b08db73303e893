#pragma once
// Words that stand for the values of an enumeration in files and messages.

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace thinwall::core {

/// The words of an enumeration in the order of its values, which count from 0. Each enumeration that is written in
/// files specialises it beside its declaration, as a std::array of std::string_view.
template <class Enum>
inline constexpr std::array<std::string_view, 0> words{};

/// The word of a value.
template <class Enum>
[[nodiscard]] std::string word_of(Enum value) {
  return std::string(words<Enum>[static_cast<std::size_t>(value)]);
}

/// The value of a word; none for a word that is not one of the enumeration's.
template <class Enum>
[[nodiscard]] std::optional<Enum> from_word(std::string_view word) {
  const auto found = std::ranges::find(words<Enum>, word);
  if (found == words<Enum>.end()) return std::nullopt;
  return static_cast<Enum>(found - words<Enum>.begin());
}

}  // namespace thinwall::core

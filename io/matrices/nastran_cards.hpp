#pragma once
// Bulk data of Nastran below the level of meaning: small and large fields, free format, continuations, its numbers.
//
// Layout: MSC Nastran Quick Reference Guide, "Format of Bulk Data entries".

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace thinwall::io {

/// An entry with its continuations: fields 2 to 9 of each line (2 to 5 of a line with large fields), trimmed, missing
/// ones empty. The views are into the bytes.
struct NastranCard {
  std::string_view name;  ///< without '*'
  std::vector<std::string_view> fields;
  int line = 0;  ///< where it begins
};

/// Goes through the bytes and hands over every entry whose name `wanted` accepts; lines of comment ('$') and other
/// lines are passed over. Memory: of one entry. Cost O(bytes).
void for_each_card(std::string_view bytes, const std::function<bool(std::string_view)>& wanted,
                   const std::function<void(const NastranCard&)>& take);

/// The finite number in a field, "1.5", "-3.+7", "2.5D-3", "1.E6". Throws DataError "name:line: ...".
[[nodiscard]] double nastran_real(std::string_view field, const std::string& name, int line);

/// The whole number in a field, from `least` to `most`. Throws DataError "name:line: ...", calling it `what`.
[[nodiscard]] int nastran_integer(std::string_view field, const char* what, int least, int most,
                                  const std::string& name, int line);

/// A finite number in at most 16 characters, "175579830.638123" or "1.2345678901234+9": the same number where that is
/// possible, which is so for all that were read from such a field, else the nearer form, with 14 digits or more between
/// 0.1 and 1e13 and 11 at worst (a negative number with an exponent of three digits 10).
[[nodiscard]] std::string nastran_real_text(double value);

}  // namespace thinwall::io

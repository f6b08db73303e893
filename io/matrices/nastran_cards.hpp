#pragma once
// Nastran's bulk data as entries with fields: small and large fields, free format, continuations, and its numbers.
//
// Layout: MSC Nastran Quick Reference Guide, "Format of Bulk Data entries".

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace thinwall::io {

/// An entry with its continuations: fields 2 to 9 of each line (2 to 5 of a line with large fields), trimmed; missing
/// fields are empty. The views point into the bytes.
struct NastranCard {
  std::string_view name;  ///< without '*'
  std::vector<std::string_view> fields;
  int line = 0;  ///< its first line
};

/// Calls `take` for every entry whose name `wanted` accepts; comments ('$') and other lines are skipped. Memory is used
/// for one entry at a time. Cost O(bytes).
void for_each_card(std::string_view bytes, const std::function<bool(std::string_view)>& wanted,
                   const std::function<void(const NastranCard&)>& take);

/// The finite number in a field, such as "1.5", "-3.+7", "2.5D-3", "1.E6". Throws DataError "name:line: …".
[[nodiscard]] double nastran_real(std::string_view field, const std::string& name, int line);

/// The whole number in a field, from `least` to `most`. Throws DataError "name:line: …" with `what` as its name.
[[nodiscard]] int nastran_integer(std::string_view field, const char* what, int least, int most,
                                  const std::string& name, int line);

/// A finite number in at most 16 characters, such as "175579830.638123" or "1.2345678901234+9". It is exact if that is
/// possible, which is so for all numbers that were read from such a field; otherwise it is the nearer of both forms,
/// with at least 14 digits between 0.1 and 1e13 and 11 at worst (10 for a negative number with an exponent of three
/// digits).
[[nodiscard]] std::string nastran_real_text(double value);

}  // namespace thinwall::io

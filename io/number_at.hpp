#pragma once
// Numbers in the bytes of a file.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <string_view>

namespace thinwall::io {

/// The number of that type at a place that lies within the bytes, of either byte order.
template <class Number>
[[nodiscard]] Number number_at(std::string_view bytes, std::size_t at, bool big_endian) {
  std::array<char, sizeof(Number)> raw{};
  std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), raw.size(), raw.begin());
  if (big_endian != (std::endian::native == std::endian::big)) std::reverse(raw.begin(), raw.end());
  Number value{};
  std::memcpy(&value, raw.data(), sizeof value);
  return value;
}

}  // namespace thinwall::io

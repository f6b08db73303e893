#pragma once
// Bytes as text.

#include <string>
#include <string_view>

namespace thinwall::io {

/// RFC 4648, with padding, without line breaks.
[[nodiscard]] std::string base64(std::string_view bytes);

/// Bytes of a base64 text with padding and without blanks. Throws DataError for anything else.
[[nodiscard]] std::string from_base64(std::string_view text);

/// Bytes compressed as RFC 1950 (zlib) says. Throws NumericalError if zlib fails (no memory).
[[nodiscard]] std::string deflated(std::string_view bytes);

/// The inverse of deflated(); at most `limit` bytes. Throws DataError for damaged data or more than that.
[[nodiscard]] std::string inflated(std::string_view bytes, std::size_t limit);

}  // namespace thinwall::io

#pragma once
// Encodings of bytes: base64 text, and zlib compression.

#include <string>
#include <string_view>

namespace thinwall::io {

/// The bytes as base64 text (RFC 4648), with padding, without line breaks.
[[nodiscard]] std::string base64(std::string_view bytes);

/// The bytes of a base64 text with padding and without blanks. Throws DataError for any other text.
[[nodiscard]] std::string from_base64(std::string_view text);

/// The bytes compressed in zlib's format (RFC 1950). Throws NumericalError if zlib fails (no memory).
[[nodiscard]] std::string deflated(std::string_view bytes);

/// The bytes that deflated() has compressed, at most `limit` of them. Throws DataError for damaged data or for more.
[[nodiscard]] std::string inflated(std::string_view bytes, std::size_t limit);

}  // namespace thinwall::io

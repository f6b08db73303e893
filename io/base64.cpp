#include "io/base64.hpp"

#include <openssl/evp.h>
#include <zlib.h>

#include "core/error.hpp"

namespace thinwall::io {

namespace {

const unsigned char* data(std::string_view bytes) {
  return reinterpret_cast<const unsigned char*>(bytes.data());
}

}  // namespace

std::string base64(std::string_view bytes) {
  std::string text(4 * ((bytes.size() + 2) / 3) + 1, '\0');
  const int length =
      EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()), data(bytes), static_cast<int>(bytes.size()));
  text.resize(static_cast<std::size_t>(length));
  return text;
}

std::string from_base64(std::string_view text) {
  std::string bytes(3 * (text.size() / 4) + 1, '\0');
  const int length =
      EVP_DecodeBlock(reinterpret_cast<unsigned char*>(bytes.data()), data(text), static_cast<int>(text.size()));
  if (length < 0 || text.size() % 4 != 0) throw core::DataError("not base64");
  const std::size_t padding = text.ends_with("==") ? 2 : text.ends_with("=") ? 1 : 0;
  bytes.resize(static_cast<std::size_t>(length) - padding);
  return bytes;
}

std::string deflated(std::string_view bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string result(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(result.data()), &size, data(bytes), static_cast<uLong>(bytes.size()),
                Z_DEFAULT_COMPRESSION) != Z_OK)
    throw core::NumericalError("zlib could not compress " + std::to_string(bytes.size()) + " bytes");
  result.resize(size);
  return result;
}

std::string inflated(std::string_view bytes, std::size_t limit) {
  std::string result(limit, '\0');
  uLongf size = static_cast<uLongf>(limit);
  if (uncompress(reinterpret_cast<Bytef*>(result.data()), &size, data(bytes), static_cast<uLong>(bytes.size())) != Z_OK)
    throw core::DataError("compressed data is damaged, or longer than " + std::to_string(limit) + " bytes");
  result.resize(size);
  return result;
}

}  // namespace thinwall::io

#include "io/mesh/vtu_array.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <type_traits>

#include "core/error.hpp"
#include "io/number_at.hpp"
#include "io/surface_text.hpp"

namespace thinwall::io {

namespace {

/// Bound on the expansion by zlib; the largest ratio of its method is 1032.
constexpr std::uint64_t largest_expansion = 1100;

[[noreturn]] void fail(const VtuEncoding& encoding, const VtuArray& array, const std::string& what) {
  throw core::DataError(encoding.path + ": array " + io::quoted(array.name) + ": " + what);
}

int base64_value(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+') return 62;
  return c == '/' ? 63 : -1;
}

/// A reader of raw or base64 bytes. VTK pads a heading and its data separately, so that '=' ends a group, not the text.
class Bytes {
 public:
  Bytes(std::string_view text, bool is_base64) : text_(text), is_base64_(is_base64) {}

  /// An upper bound on the number of bytes that are left.
  [[nodiscard]] std::uint64_t most() const { return group_.size() + text_.size(); }

  /// The next bytes; fewer if the text ends or is no base64.
  std::string take(std::uint64_t count) {
    if (!is_base64_) {
      std::string taken(text_.substr(0, count));
      text_.remove_prefix(taken.size());
      return taken;
    }
    std::string taken;
    taken.reserve(std::min(count, most()));
    while (taken.size() < count && (!group_.empty() || read_group())) {
      const std::size_t part = std::min<std::size_t>(group_.size(), count - taken.size());
      taken.append(group_, 0, part);
      group_.erase(0, part);
    }
    return taken;
  }

 private:
  bool read_group() {
    std::uint32_t bits = 0;
    int digits = 0;
    int padding = 0;
    while (digits + padding < 4) {
      if (text_.empty()) return false;
      const char c = text_.front();
      const int value = base64_value(c);
      const bool is_blank = c == ' ' || c == '\n' || c == '\r' || c == '\t';
      if (!is_blank && value < 0 && c != '=') return false;
      text_.remove_prefix(1);
      if (is_blank) continue;
      if (c == '=') ++padding;
      if (c != '=') ++digits;
      bits = (bits << 6U) | static_cast<std::uint32_t>(std::max(value, 0));
    }
    for (int k = 0; k < digits - 1; ++k) group_.push_back(static_cast<char>((bits >> (16 - 8 * k)) & 0xFFU));
    return digits > 1;
  }

  std::string_view text_;
  bool is_base64_;
  std::string group_;
};

std::uint64_t header_number(const VtuEncoding& encoding, const VtuArray& array, Bytes& bytes) {
  const std::size_t size = encoding.wide_header ? 8 : 4;
  const std::string taken = bytes.take(size);
  if (taken.size() < size) fail(encoding, array, "ends within its length: the file is truncated");
  return encoding.wide_header ? number_at<std::uint64_t>(taken, 0, encoding.big_endian)
                              : number_at<std::uint32_t>(taken, 0, encoding.big_endian);
}

std::string inflated(const VtuEncoding& encoding, const VtuArray& array, const std::string& block, std::uint64_t size) {
  if (size > largest_expansion * (block.size() + 1))
    fail(encoding, array, "a block of " + std::to_string(block.size()) + " bytes cannot hold " + std::to_string(size));
  std::string data(size, '\0');
  uLongf length = size;
  const int status = ::uncompress(reinterpret_cast<Bytef*>(data.data()), &length,
                                  reinterpret_cast<const Bytef*>(block.data()), block.size());
  if (status != Z_OK || length != size) fail(encoding, array, "a compressed block is broken");
  return data;
}

/// The data of compressed blocks. Their heading contains the number of blocks, the size of a block, the size of the
/// last one (0: as the others) and the compressed sizes.
std::string compressed_data(const VtuEncoding& encoding, const VtuArray& array, Bytes& bytes) {
  const std::uint64_t blocks = header_number(encoding, array, bytes);
  const std::uint64_t size = header_number(encoding, array, bytes);
  const std::uint64_t last = header_number(encoding, array, bytes);
  if (blocks > bytes.most()) fail(encoding, array, "has more blocks than bytes");
  std::vector<std::uint64_t> sizes;
  for (std::uint64_t b = 0; b < blocks; ++b) sizes.push_back(header_number(encoding, array, bytes));
  std::string data;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    if (sizes[b] > bytes.most()) fail(encoding, array, "is truncated");
    const std::string block = bytes.take(sizes[b]);
    if (block.size() < sizes[b]) fail(encoding, array, "is truncated");
    const std::uint64_t expected = b + 1 == blocks && last > 0 ? last : size;
    if (expected > encoding.most_bytes || data.size() + expected > encoding.most_bytes)
      fail(encoding, array, "decompresses to more than " + std::to_string(encoding.most_bytes) + " bytes");
    data += inflated(encoding, array, block, expected);
  }
  return data;
}

std::string binary_data(const VtuEncoding& encoding, const VtuArray& array) {
  const bool appended = array.format == "appended";
  if (appended && array.offset > encoding.appended.size())
    fail(encoding, array, "begins behind the appended data: the file is truncated");
  Bytes bytes(appended ? encoding.appended.substr(array.offset) : array.text, !appended || encoding.appended_base64);
  if (!appended) {
    const auto begin = array.text.find_first_not_of(" \t\r\n");
    if (begin == std::string_view::npos) return {};
  }
  if (encoding.zlib) return compressed_data(encoding, array, bytes);
  const std::uint64_t size = header_number(encoding, array, bytes);
  std::string data = size > bytes.most() ? std::string() : bytes.take(size);
  if (data.size() < size) fail(encoding, array, "is truncated: " + std::to_string(size) + " bytes are announced");
  return data;
}

template <class T, class Out>
std::vector<Out> converted(const VtuEncoding& encoding, const VtuArray& array, const std::string& data) {
  if (data.size() % sizeof(T) != 0) fail(encoding, array, "holds no whole number of values");
  std::vector<Out> values(data.size() / sizeof(T));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const T value = number_at<T>(data, i * sizeof(T), encoding.big_endian);
    if constexpr (std::is_same_v<T, std::uint64_t> && std::is_integral_v<Out>) {
      if (value > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
        fail(encoding, array, "holds a number beyond 2^63");
    }
    values[i] = static_cast<Out>(value);
  }
  return values;
}

template <class Out>
std::vector<Out> words(const VtuEncoding& encoding, const VtuArray& array) {
  SurfaceText text(array.text, encoding.path + " (array " + array.name + ")", '\0');
  std::vector<Out> values;
  while (!text.at_end()) {
    if constexpr (std::is_integral_v<Out>) {
      values.push_back(text.whole_number("a value", std::numeric_limits<Out>::min(), std::numeric_limits<Out>::max()));
    } else {
      values.push_back(text.number("a value"));
    }
  }
  return values;
}

template <class Out>
std::vector<Out> numbers(const VtuEncoding& encoding, const VtuArray& array) {
  if (array.format == "ascii") return words<Out>(encoding, array);
  if (array.format != "binary" && array.format != "appended")
    fail(encoding, array,
         "has the format " + io::quoted(array.format) + "; \"ascii\", \"binary\" and \"appended\" are read");
  const std::string data = binary_data(encoding, array);
  const std::string& type = array.type;
  if (type == "Int8") {
    std::vector<Out> values = converted<std::uint8_t, Out>(encoding, array, data);
    for (Out& value : values)
      if (value > 127) value -= 256;
    return values;
  }
  if (type == "UInt8") return converted<std::uint8_t, Out>(encoding, array, data);
  if (type == "Int16") return converted<std::int16_t, Out>(encoding, array, data);
  if (type == "UInt16") return converted<std::uint16_t, Out>(encoding, array, data);
  if (type == "Int32") return converted<std::int32_t, Out>(encoding, array, data);
  if (type == "UInt32") return converted<std::uint32_t, Out>(encoding, array, data);
  if (type == "Int64") return converted<std::int64_t, Out>(encoding, array, data);
  if (type == "UInt64") return converted<std::uint64_t, Out>(encoding, array, data);
  if constexpr (!std::is_integral_v<Out>) {
    if (type == "Float32") return converted<float, Out>(encoding, array, data);
    if (type == "Float64") return converted<double, Out>(encoding, array, data);
  }
  fail(encoding, array, "has the type " + io::quoted(type) + ", which does not belong there");
}

}  // namespace

std::vector<double> vtu_reals(const VtuEncoding& encoding, const VtuArray& array) {
  return numbers<double>(encoding, array);
}

std::vector<std::int64_t> vtu_integers(const VtuEncoding& encoding, const VtuArray& array) {
  return numbers<std::int64_t>(encoding, array);
}

}  // namespace thinwall::io

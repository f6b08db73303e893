#pragma once
// Fortran's unformatted records as bytes, for tests of their readers.

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace thinwall::io::test {

/// Fortran's records in the byte order and with the words wanted.
struct FortranWriter {
  bool turned = false;  ///< the other byte order than this machine's
  bool wide = false;    ///< words of 8 bytes
  bool single = false;

  template <class Number>
  [[nodiscard]] std::string raw(Number number) const {
    std::string bytes(sizeof number, '\0');
    std::memcpy(bytes.data(), &number, sizeof number);
    return turned ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
  }
  [[nodiscard]] std::string whole(const std::vector<std::int64_t>& numbers) const {
    std::string bytes;
    for (const std::int64_t number : numbers) bytes += wide ? raw(number) : raw(static_cast<std::int32_t>(number));
    return bytes;
  }
  [[nodiscard]] std::string real(const std::vector<double>& numbers) const {
    std::string bytes;
    for (const double number : numbers) bytes += single && !wide ? raw(static_cast<float>(number)) : raw(number);
    return bytes;
  }
  [[nodiscard]] std::string record(const std::string& data) const {
    const std::string length = raw(static_cast<std::int32_t>(data.size()));
    return length + data + length;
  }
  /// The words of a number.
  [[nodiscard]] std::int64_t words() const { return single || wide ? 1 : 2; }
};

}  // namespace thinwall::io::test

#include "io/mesh/gmsh_numbers.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "core/error.hpp"

namespace thinwall::io {

GmshNumbers::GmshNumbers(std::string_view bytes, std::string name)
    : name_(std::move(name)), size_(bytes.size()), text_(bytes, name_, '\0') {}

void GmshNumbers::fail(const std::string& what) const {
  if (!is_binary_) text_.fail(what);
  throw core::DataError(name_ + ": byte " + std::to_string(size_ - text_.bytes_left()) + ": " + what);
}

template <class T>
T GmshNumbers::taken(const char* what) {
  const std::string_view bytes = text_.take(sizeof(T));
  if (bytes.size() < sizeof(T)) fail(std::string("the file ends where ") + what + " belongs");
  std::array<char, sizeof(T)> own{};
  std::copy(bytes.begin(), bytes.end(), own.begin());
  if (is_turned_) std::reverse(own.begin(), own.end());
  T value{};
  std::memcpy(&value, own.data(), sizeof(T));
  return value;
}

void GmshNumbers::begin_binary() {
  is_binary_ = true;
  const auto one = taken<std::int32_t>("the number 1 that tells the order of bytes");
  is_turned_ = one == 0x01000000;
  if (one != 1 && !is_turned_) fail("the number 1 that tells the order of bytes is " + std::to_string(one));
}

std::int64_t GmshNumbers::within(std::int64_t value, const char* what, std::int64_t least, std::int64_t most) const {
  if (value < least || value > most)
    fail(std::string(what) + " is " + std::to_string(value) + "; a whole number from " + std::to_string(least) +
         " to " + std::to_string(most) + " belongs there");
  return value;
}

std::int64_t GmshNumbers::integer(const char* what, std::int64_t least, std::int64_t most) {
  if (!is_binary_) return text_.whole_number(what, least, most);
  return within(taken<std::int32_t>(what), what, least, most);
}

std::int64_t GmshNumbers::count(const char* what, std::int64_t least, std::int64_t most) {
  if (!is_binary_) return text_.whole_number(what, least, most);
  return within(taken<std::int64_t>(what), what, least, most);
}

double GmshNumbers::real(const char* what) {
  if (!is_binary_) return text_.number(what);
  return taken<double>(what);
}

}  // namespace thinwall::io

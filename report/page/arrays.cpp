#include "report/page/arrays.hpp"

#include <bit>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "io/base64.hpp"

namespace thinwall::report {

namespace {

static_assert(std::endian::native == std::endian::little, "arrays of a page are little-endian");

template <class Number>
nlohmann::json packed_as(const char* type, const std::vector<Number>& values, const std::vector<std::size_t>& shape) {
  const std::size_t count = std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
  if (count != values.size())
    throw core::InputError("an array of a page holds " + std::to_string(values.size()) + " numbers, its shape " +
                           std::to_string(count));
  const char* bytes = reinterpret_cast<const char*>(values.data());
  std::string shuffled(count * sizeof(Number), '\0');
  for (std::size_t byte = 0; byte < sizeof(Number); ++byte) {
    for (std::size_t i = 0; i < count; ++i) shuffled[byte * count + i] = bytes[i * sizeof(Number) + byte];
  }
  return {{"type", type}, {"shape", shape}, {"shuffled", true}, {"deflate", io::base64(io::deflated(shuffled))}};
}

}  // namespace

nlohmann::json packed(const std::vector<double>& values, const std::vector<std::size_t>& shape) {
  return packed_as("f64", values, shape);
}

nlohmann::json packed(const std::vector<float>& values, const std::vector<std::size_t>& shape) {
  return packed_as("f32", values, shape);
}

nlohmann::json packed(const std::vector<std::int16_t>& values, const std::vector<std::size_t>& shape) {
  return packed_as("i16", values, shape);
}

nlohmann::json packed(const std::vector<std::uint32_t>& values, const std::vector<std::size_t>& shape) {
  return packed_as("u32", values, shape);
}

float for_picture(double value, int bits_kept) {
  const auto single = static_cast<float>(value);
  if (!std::isfinite(single)) return single;
  const auto dropped = static_cast<std::uint32_t>(23 - bits_kept);
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(single) + (1U << (dropped - 1));
  const auto rounded = std::bit_cast<float>(bits & ~((1U << dropped) - 1U));
  return std::isfinite(rounded) ? rounded : single;
}

}  // namespace thinwall::report

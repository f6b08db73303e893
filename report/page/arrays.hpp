#pragma once
// Numbers as a page carries them.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

namespace thinwall::report {

/// {"type", "shape", "shuffled", "deflate"}: little-endian numbers, row-major, their first bytes before all second ones
/// and so on (which halves what is left), compressed by zlib, as base64. NaN stands for "no value". The numbers must
/// fill the shape; throws InputError otherwise.
[[nodiscard]] nlohmann::json packed(const std::vector<double>& values, const std::vector<std::size_t>& shape);
[[nodiscard]] nlohmann::json packed(const std::vector<float>& values, const std::vector<std::size_t>& shape);
[[nodiscard]] nlohmann::json packed(const std::vector<std::int16_t>& values, const std::vector<std::size_t>& shape);
[[nodiscard]] nlohmann::json packed(const std::vector<std::uint32_t>& values, const std::vector<std::size_t>& shape);

/// The nearest float with so many bits of mantissa, 1 to 22 (15: 1.5e-5 relative): what a picture shows, in half the
/// compressed size.
[[nodiscard]] float for_picture(double value, int bits_kept = 15);

}  // namespace thinwall::report

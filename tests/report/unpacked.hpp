#pragma once
// Arrays of a page, decoded as the page does it.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/base64.hpp"

namespace thinwall::report {

/// base64, zlib, the bytes put back in their places.
template <class Number>
std::vector<Number> unpacked(const nlohmann::json& array) {
  std::size_t count = 1;
  for (const auto& extent : array["shape"]) count *= extent.get<std::size_t>();
  const std::string bytes =
      io::inflated(io::from_base64(array["deflate"].get<std::string>()), count * sizeof(Number) + 1);
  EXPECT_EQ(bytes.size(), count * sizeof(Number));
  std::vector<Number> values(count);
  auto* out = reinterpret_cast<char*>(values.data());
  for (std::size_t byte = 0; byte < sizeof(Number); ++byte) {
    for (std::size_t i = 0; i < count; ++i) out[i * sizeof(Number) + byte] = bytes[byte * count + i];
  }
  return values;
}

}  // namespace thinwall::report

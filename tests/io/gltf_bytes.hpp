#pragma once
// glTF files, put together by hand from the specification.

#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <utility>

#include "io/base64.hpp"

namespace thinwall::io::test {

inline void append_word(std::string& bytes, std::uint32_t word) {
  char raw[4];
  std::memcpy(raw, &word, 4);
  bytes.append(raw, 4);
}

/// A binary glTF of a JSON and a chunk of numbers.
inline std::string glb_of(std::string text, std::string numbers) {
  while (text.size() % 4 != 0) text += ' ';
  while (numbers.size() % 4 != 0) numbers += '\0';
  std::string bytes = "glTF";
  append_word(bytes, 2);
  append_word(bytes, static_cast<std::uint32_t>(28 + text.size() + numbers.size()));
  append_word(bytes, static_cast<std::uint32_t>(text.size()));
  bytes += "JSON" + text;
  append_word(bytes, static_cast<std::uint32_t>(numbers.size()));
  return bytes + std::string("BIN\0", 4) + numbers;
}

/// A tetrahedron with corners at 0 and at 3, 2 and 10 m along the axes: volume 10 m³. Points lie 16 bytes apart, the
/// twelve indices, two bytes each, behind them.
inline std::string tetrahedron_numbers() {
  const float points[4][4] = {{0, 0, 0, 9}, {3, 0, 0, 9}, {0, 2, 0, 9}, {0, 0, 10, 9}};
  const std::uint16_t corners[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  std::string bytes(sizeof points + sizeof corners, '\0');
  std::memcpy(bytes.data(), points, sizeof points);
  std::memcpy(bytes.data() + sizeof points, corners, sizeof corners);
  return bytes;
}

inline const std::string embedded =
    "\"uri\":\"data:application/octet-stream;base64," + base64(tetrahedron_numbers()) + "\",";

/// The JSON of a scene with these nodes, of which the first is shown; meshes[0] is the tetrahedron. `replaced` are
/// pairs of a text and what takes its place.
inline std::string gltf_json(const std::string& nodes, const std::string& uri = embedded,
                             std::initializer_list<std::pair<std::string, std::string>> replaced = {}) {
  std::string text =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)" + nodes +
      R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"accessors":[)"
      R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
      R"({"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],"bufferViews":[)"
      R"({"buffer":0,"byteLength":64,"byteStride":16},{"buffer":0,"byteOffset":64,"byteLength":24}],"buffers":[{)" +
      uri + R"("byteLength":88}]})";
  for (const auto& [from, to] : replaced) {
    const auto at = text.find(from);
    if (at != std::string::npos) text.replace(at, from.size(), to);
  }
  return text;
}

}  // namespace thinwall::io::test

#pragma once
// Surfaces as files of every format, written without the program's own writers.

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "core/units.hpp"
#include "io/surface/stl.hpp"
#include "mesh/triangle_soup.hpp"

namespace thinwall::io::test {

/// "0.1 0.2 0.3", each as short as it reads back to the last bit.
inline std::string words(const Eigen::Vector3d& x) {
  return core::number_text(x(0)) + " " + core::number_text(x(1)) + " " + core::number_text(x(2));
}

inline const Eigen::Vector3d& corner(const mesh::TriangleSoup& soup, std::size_t t, std::size_t k) {
  return soup.points[static_cast<std::size_t>(soup.triangles[t][k])];
}

inline std::string ascii_stl(const mesh::TriangleSoup& soup) {
  std::string text = "solid part\n";
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (std::size_t k = 0; k < 3; ++k) text += "      vertex " + words(corner(soup, t, k)) + "\n";
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid part\n";
}

inline std::string off_text(const mesh::TriangleSoup& soup) {
  std::string text =
      "OFF # a part\n" + std::to_string(soup.points.size()) + " " + std::to_string(soup.triangles.size()) + " 0\n\n";
  for (const auto& x : soup.points) text += words(x) + "\n";
  for (const auto& t : soup.triangles) {
    text += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + " 255 0 0\n";
  }
  return text;
}

inline std::string obj_text(const mesh::TriangleSoup& soup) {
  std::string text = "# a part\no part\n";
  for (const auto& x : soup.points) text += "v " + words(x) + "\n";
  text += "vn 0 0 1\ns off\n";
  for (const auto& t : soup.triangles) {
    text += "f";
    for (const int p : t) text += " " + std::to_string(p + 1) + "//1";
    text += "\n";
  }
  return text;
}

inline std::string ply_heading(const std::string& format, std::size_t points, std::size_t facets) {
  return "ply\nformat " + format + " 1.0\ncomment a part\nelement vertex " + std::to_string(points) +
         "\nproperty double x\nproperty double y\nproperty double z\nelement face " + std::to_string(facets) +
         "\nproperty list uchar int vertex_indices\nend_header\n";
}

inline std::string ascii_ply(const mesh::TriangleSoup& soup) {
  std::string text = ply_heading("ascii", soup.points.size(), soup.triangles.size());
  for (const auto& x : soup.points) text += words(x) + "\n";
  for (const auto& t : soup.triangles)
    text += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
  return text;
}

template <class T>
void append_value(std::string& bytes, T value, bool big_endian) {
  std::array<char, sizeof value> raw{};
  std::memcpy(raw.data(), &value, sizeof value);
  if (big_endian) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

inline std::string binary_ply(const mesh::TriangleSoup& soup, bool big_endian) {
  std::string bytes =
      ply_heading(big_endian ? "binary_big_endian" : "binary_little_endian", soup.points.size(), soup.triangles.size());
  for (const auto& x : soup.points)
    for (int k = 0; k < 3; ++k) append_value(bytes, x(k), big_endian);
  for (const auto& t : soup.triangles) {
    bytes += '\3';
    for (const int p : t) append_value(bytes, static_cast<std::int32_t>(p), big_endian);
  }
  return bytes;
}

/// The program's own binary STL, with a heading that begins with "solid" as many exporters write it.
inline std::string binary_stl_of_solid(const mesh::TriangleSoup& soup, double metres_per_unit) {
  std::string bytes = stl_bytes(soup, metres_per_unit);
  return bytes.replace(0, 10, "solid part");
}

struct SurfaceBytes {
  std::string extension;
  std::string bytes;
};

/// The same coordinates (as numbers, whatever their unit) in every format that is read.
inline std::vector<SurfaceBytes> every_format(const mesh::TriangleSoup& soup) {
  return {{".stl", ascii_stl(soup)},        {".STL", stl_bytes(soup, 1.0)},   {".stl", binary_stl_of_solid(soup, 1.0)},
          {".off", off_text(soup)},         {".obj", obj_text(soup)},         {".ply", ascii_ply(soup)},
          {".ply", binary_ply(soup, true)}, {".ply", binary_ply(soup, false)}};
}

}  // namespace thinwall::io::test

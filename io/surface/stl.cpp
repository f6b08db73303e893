#include "io/surface/stl.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/surface_text.hpp"
#include "io/surface_unit.hpp"

namespace thinwall::io {

namespace {

constexpr std::size_t heading_size = 84;  // 80 arbitrary bytes, then the count
constexpr std::size_t facet_size = 50;    // normal, three corners, two bytes
constexpr std::size_t normal_size = 12;
static_assert(std::endian::native == std::endian::little, "STL is little-endian");

std::size_t stated_facets(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + heading_size - sizeof count, sizeof count);
  return count;
}

bool has_binary_size(std::string_view bytes) {
  return bytes.size() >= heading_size && bytes.size() == heading_size + facet_size * stated_facets(bytes);
}

/// True if the file begins with "solid" and its first bytes are all possible in text.
bool looks_like_text(std::string_view bytes) {
  constexpr std::size_t examined = 1000;
  const auto first = bytes.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || lower_case(bytes.substr(first, 5)) != "solid") return false;
  const std::string_view beginning = bytes.substr(0, examined);
  return std::none_of(beginning.begin(), beginning.end(), [](char c) { return c >= '\0' && c < '\t'; });
}

/// Adds a facet with three points of its own; equal points are merged later.
void add_facet(mesh::TriangleSoup& soup, const std::array<Eigen::Vector3d, 3>& corners) {
  const int first = static_cast<int>(soup.points.size());
  soup.points.insert(soup.points.end(), corners.begin(), corners.end());
  soup.triangles.push_back({first, first + 1, first + 2});
}

/// Points are numbered by int, three a facet.
constexpr std::size_t most_facets = 700'000'000;

mesh::TriangleSoup binary_surface(std::string_view bytes, const std::string& name, double metres_per_unit) {
  mesh::TriangleSoup soup;
  const std::size_t count = stated_facets(bytes);
  if (count > most_facets)
    throw core::DataError(name + ": " + std::to_string(count) + " facets; give at most 700000000");
  soup.points.reserve(3 * count);
  soup.triangles.reserve(count);
  for (std::size_t f = 0; f < count; ++f) {
    const std::size_t offset = heading_size + f * facet_size;
    std::array<float, 9> numbers{};
    std::memcpy(numbers.data(), bytes.data() + offset + normal_size, sizeof numbers);
    std::array<Eigen::Vector3d, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = Eigen::Vector3f(numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]).cast<double>();
      if (!corners[k].allFinite()) {
        throw core::DataError(name + ": facet " + std::to_string(f + 1) + " (byte " + std::to_string(offset) +
                              ") has a corner that is not finite; export the surface again");
      }
      corners[k] *= metres_per_unit;
    }
    add_facet(soup, corners);
  }
  return soup;
}

[[noreturn]] void refuse_size(std::string_view bytes, const std::string& name) {
  if (bytes.size() < heading_size) {
    throw core::DataError(name + ": " + std::to_string(bytes.size()) +
                          " bytes are no STL file: neither text that begins with \"solid\" nor 84 bytes of a heading");
  }
  const std::size_t stated = stated_facets(bytes);
  const std::size_t wanted = heading_size + facet_size * stated;
  const std::string what = bytes.size() < wanted ? "it is truncated, or no STL file" : "something follows them";
  throw core::DataError(name + ": byte 80 states " + std::to_string(stated) + " facets, " + std::to_string(wanted) +
                        " bytes, but the file has " + std::to_string(bytes.size()) + ": " + what +
                        "; export the surface again");
}

/// A reader of the facets of a text, which may contain several solids.
class TextReader {
 public:
  TextReader(std::string_view bytes, const std::string& name, double metres_per_unit)
      : text_(bytes, name, '\0'), metres_per_unit_(metres_per_unit) {}

  mesh::TriangleSoup read() {
    while (!text_.at_end()) {
      expect("solid");
      text_.skip_line();  // the name of the solid
      read_solid();
    }
    return std::move(soup_);
  }

 private:
  void read_solid() {
    for (;;) {
      const std::string_view word = text_.word();
      if (is(word, "endsolid")) break;
      if (word.empty()) text_.fail("the text ends before \"endsolid\": the file is truncated");
      if (!is(word, "facet")) text_.fail(quoted(word) + " where \"facet\" or \"endsolid\" belongs");
      read_facet();
    }
    text_.skip_line();
  }

  void read_facet() {
    if (soup_.triangles.size() >= most_facets) text_.fail("more than 700000000 facets");
    expect("normal");
    for (int k = 0; k < 3; ++k) (void)text_.word();
    expect("outer");
    expect("loop");
    std::array<Eigen::Vector3d, 3> corners;
    for (auto& x : corners) {
      expect("vertex");
      for (int k = 0; k < 3; ++k) x(k) = metres_per_unit_ * text_.number("a coordinate");
    }
    expect("endloop");
    expect("endfacet");
    add_facet(soup_, corners);
  }

  static bool is(std::string_view word, std::string_view keyword) {
    return word == keyword || (word.size() == keyword.size() && lower_case(word) == keyword);
  }

  void expect(const char* keyword) {
    const std::string_view word = text_.word();
    if (is(word, keyword)) return;
    if (word.empty()) text_.fail(std::string("the text ends where \"") + keyword + "\" belongs: the file is truncated");
    text_.fail(quoted(word) + " where \"" + keyword + "\" belongs; a facet of STL has three vertices");
  }

  SurfaceText text_;
  double metres_per_unit_;
  mesh::TriangleSoup soup_;
};

void append_float(std::string& bytes, double value) {
  const auto rounded = static_cast<float>(value);
  if (!std::isfinite(rounded))
    throw core::InputError("the coordinate " + std::to_string(value) + " does not fit into STL; choose a larger unit");
  std::array<char, sizeof rounded> raw{};
  std::memcpy(raw.data(), &rounded, sizeof rounded);
  bytes.append(raw.data(), raw.size());
}

}  // namespace

mesh::TriangleSoup stl_surface(std::string_view bytes, const std::string& name, double metres_per_unit) {
  require_metres_per_unit(metres_per_unit, name);
  const bool is_binary = has_binary_size(bytes);
  if (!is_binary && !looks_like_text(bytes)) refuse_size(bytes, name);
  const mesh::TriangleSoup soup =
      is_binary ? binary_surface(bytes, name, metres_per_unit) : TextReader(bytes, name, metres_per_unit).read();
  if (soup.triangles.empty()) throw core::DataError(name + ": holds no facets; export the surface again");
  return mesh::merged_points(soup).soup;
}

mesh::TriangleSoup read_stl(const std::filesystem::path& path, double metres_per_unit) {
  return stl_surface(core::read_file(path), path.string(), metres_per_unit);
}

std::string stl_bytes(const mesh::TriangleSoup& soup, double metres_per_unit) {
  require_metres_per_unit(metres_per_unit, "the STL file to write");
  std::string bytes = "binary STL";
  bytes.resize(heading_size - sizeof(std::uint32_t), ' ');
  const auto count = static_cast<std::uint32_t>(soup.triangles.size());
  std::array<char, sizeof count> raw{};
  std::memcpy(raw.data(), &count, sizeof count);
  bytes.append(raw.data(), raw.size());
  bytes.reserve(heading_size + facet_size * soup.triangles.size());
  for (const auto& triangle : soup.triangles) {
    std::array<Eigen::Vector3d, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = soup.points.at(static_cast<std::size_t>(triangle[k]));
    const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).stableNormalized();
    for (int k = 0; k < 3; ++k) append_float(bytes, normal(k));
    for (const auto& x : corners)
      for (int k = 0; k < 3; ++k) append_float(bytes, x(k) / metres_per_unit);
    bytes.append(2, '\0');
  }
  return bytes;
}

void write_stl(const std::filesystem::path& path, const mesh::TriangleSoup& soup, double metres_per_unit) {
  core::write_file_atomically(path, stl_bytes(soup, metres_per_unit));
}

}  // namespace thinwall::io

#include "io/surface/off.hpp"

#include <algorithm>
#include <limits>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/surface/surface_facets.hpp"
#include "io/surface_text.hpp"
#include "io/surface_unit.hpp"

namespace thinwall::io {

namespace {

/// Reads the heading, which is optional, and returns the number of points. "4OFF" and "nOFF", which have other than
/// three coordinates, are refused.
std::int64_t read_off_heading(SurfaceText& text) {
  std::string_view word = text.word();
  if (word.ends_with("OFF")) {
    const std::string_view kind = word.substr(0, word.size() - 3);
    if (kind.find_first_of("4n") != std::string_view::npos)
      text.fail(quoted(word) + " is not read, only three coordinates");
    word = text.word();
    if (word == "BINARY") text.fail("binary OFF is not read; export it as text");
  } else if (!word.empty() && (word.front() < '0' || word.front() > '9')) {
    text.fail(quoted(word) + " where \"OFF\" belongs");
  }
  return text.whole_number(word, "the number of points", 0, largest_int);
}

}  // namespace

mesh::TriangleSoup off_surface(std::string_view bytes, const std::string& name, double metres_per_unit) {
  require_metres_per_unit(metres_per_unit, name);
  SurfaceText text(bytes, name, '#');
  const std::int64_t points = read_off_heading(text);
  const std::int64_t count = text.whole_number("the number of facets", 1, largest_int);
  text.skip_line();  // the number of edges is not needed
  std::vector<Eigen::Vector3d> vertices;
  vertices.reserve(std::min(static_cast<std::size_t>(points), text.bytes_left() / 6));
  for (std::int64_t p = 0; p < points; ++p) {
    Eigen::Vector3d x;
    for (int k = 0; k < 3; ++k) x(k) = metres_per_unit * text.number("a coordinate");
    vertices.push_back(x);
    text.skip_line();
  }
  FacetList facets;
  for (std::int64_t f = 0; f < count; ++f) {
    const std::int64_t corners = text.whole_number("the number of a facet's corners", 3, most_corners);
    for (std::int64_t k = 0; k < corners; ++k)
      facets.corners.push_back(static_cast<int>(text.whole_number("a corner of a facet", 0, points - 1)));
    facets.ends.push_back(facets.corners.size());
    facets.places.push_back(text.line());
    text.skip_line();
  }
  return triangles_of(std::move(vertices), facets, [&name](int line, const std::string& what) {
    throw core::DataError(name + ":" + std::to_string(line) + ": " + what);
  });
}

mesh::TriangleSoup read_off(const std::filesystem::path& path, double metres_per_unit) {
  return off_surface(core::read_file(path), path.string(), metres_per_unit);
}

}  // namespace thinwall::io

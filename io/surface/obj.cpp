#include "io/surface/obj.hpp"

#include <limits>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/surface/surface_facets.hpp"
#include "io/surface_text.hpp"
#include "io/surface_unit.hpp"

namespace thinwall::io {

namespace {

/// The next word of a statement, which a '\' continues in the next line.
std::string_view word_of_statement(SurfaceText& text) {
  std::string_view word = text.word_of_line();
  while (word == "\\") {
    text.skip_line();
    word = text.word_of_line();
  }
  return word;
}

Eigen::Vector3d read_point(SurfaceText& text, double metres_per_unit) {
  Eigen::Vector3d x;
  for (int k = 0; k < 3; ++k) x(k) = metres_per_unit * text.number(word_of_statement(text), "a coordinate");
  return x;
}

/// The index from 0 of a corner, which counts from 1, or from −1 for the last point so far.
int read_corner(const SurfaceText& text, std::string_view word, std::size_t points) {
  const auto last = static_cast<std::int64_t>(points);
  const std::int64_t number =
      text.whole_number(word.substr(0, word.find('/')), "a corner of a facet", -last, largest_int);
  if (number == 0) text.fail("a facet names point 0; OBJ counts from 1");
  return static_cast<int>(number > 0 ? number - 1 : last + number);
}

void read_facet(SurfaceText& text, FacetList& facets, std::size_t points) {
  const int line = text.line();
  int corners = 0;
  for (std::string_view word = word_of_statement(text); !word.empty(); word = word_of_statement(text)) {
    if (++corners > most_corners) text.fail("a facet has more than 1000 corners; export triangles");
    facets.corners.push_back(read_corner(text, word, points));
  }
  if (corners < 3) text.fail("a facet has " + std::to_string(corners) + " corners; at least 3 belong to it");
  facets.ends.push_back(facets.corners.size());
  facets.places.push_back(line);
}

/// Skips a statement that is not read, with the lines in which it continues.
void skip_statement(SurfaceText& text) {
  while (!word_of_statement(text).empty()) {
  }
}

}  // namespace

mesh::TriangleSoup obj_surface(std::string_view bytes, const std::string& name, double metres_per_unit) {
  require_metres_per_unit(metres_per_unit, name);
  SurfaceText text(bytes, name, '#');
  std::vector<Eigen::Vector3d> points;
  FacetList facets;
  while (!text.at_end()) {
    const std::string_view keyword = text.word_of_line();
    if (keyword == "v") {
      points.push_back(read_point(text, metres_per_unit));
      if (points.size() > static_cast<std::size_t>(largest_int)) text.fail("more than 2147483647 points");
      skip_statement(text);  // a weight or a colour
    } else if (keyword == "f" || keyword == "fo") {
      read_facet(text, facets, points.size());
    } else if (keyword == "surf") {
      text.fail("a free-form surface is not read; export triangles");
    } else {
      skip_statement(text);
    }
    text.skip_line();
  }
  if (facets.ends.empty()) text.fail("the file holds no facets (\"f\"); export the surface again, as triangles");
  return triangles_of(std::move(points), facets, [&name](int line, const std::string& what) {
    throw core::DataError(name + ":" + std::to_string(line) + ": " + what);
  });
}

mesh::TriangleSoup read_obj(const std::filesystem::path& path, double metres_per_unit) {
  return obj_surface(core::read_file(path), path.string(), metres_per_unit);
}

}  // namespace thinwall::io

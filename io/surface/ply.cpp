#include "io/surface/ply.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/surface/ply_heading.hpp"
#include "io/surface/surface_facets.hpp"
#include "io/surface_text.hpp"
#include "io/surface_unit.hpp"

namespace thinwall::io {

namespace {

/// The scalar, converted to native byte order, as a double, which represents all these types exactly.
template <class T>
double as_double(const char* raw) {
  T value{};
  std::memcpy(&value, raw, sizeof value);
  return static_cast<double>(value);
}

double as_double(const char* raw, PlyType type) {
  switch (type) {
    case PlyType::int8:
      return as_double<std::int8_t>(raw);
    case PlyType::uint8:
      return as_double<std::uint8_t>(raw);
    case PlyType::int16:
      return as_double<std::int16_t>(raw);
    case PlyType::uint16:
      return as_double<std::uint16_t>(raw);
    case PlyType::int32:
      return as_double<std::int32_t>(raw);
    case PlyType::uint32:
      return as_double<std::uint32_t>(raw);
    case PlyType::float32:
      return as_double<float>(raw);
    case PlyType::float64:
      break;
  }
  return as_double<double>(raw);
}

/// A reader of values one after the other, from text or bytes.
class PlyValues {
 public:
  PlyValues(std::string_view bytes, std::string name)
      : text_(bytes, name, '\0'), name_(std::move(name)), all_(bytes.size()) {
    heading_ = read_ply_heading(text_);
    rest_ = text_.rest();
  }

  [[nodiscard]] const PlyHeading& heading() const { return heading_; }

  /// The next value of this type.
  double next(PlyType type) {
    if (is_text()) return read_text(type);
    const std::size_t size = size_of(type);
    if (rest_.size() < size) fail("the file ends within it: it is truncated");
    std::array<char, 8> raw{};
    std::memcpy(raw.data(), rest_.data(), size);
    if (heading_.format == PlyFormat::big_endian) std::reverse(raw.begin(), raw.begin() + static_cast<int>(size));
    rest_.remove_prefix(size);
    return as_double(raw.data(), type);
  }

  std::int64_t next_length(const PlyProperty& list) {
    const double length = next(list.count_type);
    if (length < 0.0) fail("a list has less than no values");
    return static_cast<std::int64_t>(length);
  }

  void skip(const PlyProperty& property) {
    const std::int64_t values = property.is_list ? next_length(property) : 1;
    for (std::int64_t i = 0; i < values; ++i) (void)next(property.type);
  }

  void go_to(const PlyElement& element, std::int64_t row) {
    element_ = &element;
    row_ = row;
  }

  void require_end() {
    element_ = nullptr;
    if (is_text() ? !text_.at_end() : !rest_.empty()) fail("something follows the last row; export the surface again");
  }

  /// Number of bytes that are left, which bounds the memory that counts may ask for.
  [[nodiscard]] std::size_t bytes_left() const { return is_text() ? text_.bytes_left() : rest_.size(); }

  [[noreturn]] void fail(const std::string& what) const {
    const std::string row = element_ == nullptr ? "" : element_->name + " " + std::to_string(row_) + ": ";
    if (is_text()) text_.fail(row + what);
    throw core::DataError(name_ + ": byte " + std::to_string(all_ - rest_.size()) + ": " + row + what);
  }

 private:
  [[nodiscard]] bool is_text() const { return heading_.format == PlyFormat::ascii; }

  double read_text(PlyType type) {
    const std::string_view word = text_.word();
    if (word.empty()) fail("the file ends within it: it is truncated");
    if (type == PlyType::float32 || type == PlyType::float64) return text_.number(word, "a value");
    return static_cast<double>(text_.whole_number(word, "a value", std::numeric_limits<std::int32_t>::min(),
                                                  std::numeric_limits<std::uint32_t>::max()));
  }

  SurfaceText text_;
  std::string name_;
  std::size_t all_;
  PlyHeading heading_;
  std::string_view rest_;
  const PlyElement* element_ = nullptr;
  std::int64_t row_ = 0;
};

std::vector<Eigen::Vector3d> read_points(PlyValues& values, const PlyElement& element, double metres_per_unit) {
  std::array<bool, 3> has{};
  std::vector<int> axis(element.properties.size(), -1);
  for (std::size_t i = 0; i < axis.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    for (std::size_t k = 0; k < 3; ++k) {
      if (property.is_list || property.name != std::string(1, "xyz"[k])) continue;
      axis[i] = static_cast<int>(k);
      has[k] = true;
    }
  }
  values.go_to(element, 0);
  if (!has[0] || !has[1] || !has[2]) values.fail("the vertices lack a property x, y or z");
  std::vector<Eigen::Vector3d> points;
  points.reserve(std::min(static_cast<std::size_t>(element.count), values.bytes_left() / 3));
  for (std::int64_t row = 0; row < element.count; ++row) {
    values.go_to(element, row);
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < axis.size(); ++i) {
      if (axis[i] < 0) {
        values.skip(element.properties[i]);
      } else {
        x(axis[i]) = metres_per_unit * values.next(element.properties[i].type);
      }
    }
    if (!x.allFinite()) values.fail("a coordinate is not finite; export the surface again");
    points.push_back(x);
  }
  return points;
}

bool is_corner_list(const PlyProperty& property) {
  return property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
}

FacetList read_facets(PlyValues& values, const PlyElement& element) {
  values.go_to(element, 0);
  if (std::count_if(element.properties.begin(), element.properties.end(), is_corner_list) != 1)
    values.fail("the faces have no list vertex_indices, or several");
  FacetList facets;
  for (std::int64_t row = 0; row < element.count; ++row) {
    values.go_to(element, row);
    for (const PlyProperty& property : element.properties) {
      if (!is_corner_list(property)) {
        values.skip(property);
        continue;
      }
      const std::int64_t length = values.next_length(property);
      if (length < 3 || length > most_corners) {
        values.fail("a facet of " + std::to_string(length) + " corners; give 3 to " + std::to_string(most_corners));
      }
      for (std::int64_t k = 0; k < length; ++k) {
        const double corner = values.next(property.type);
        const bool is_number =
            corner >= 0.0 && corner <= std::numeric_limits<int>::max() && corner == std::floor(corner);
        if (!is_number) values.fail("a corner of a facet is no number of a vertex");
        facets.corners.push_back(static_cast<int>(corner));
      }
    }
    facets.ends.push_back(facets.corners.size());
    facets.places.push_back(static_cast<int>(row));
  }
  return facets;
}

void skip_element(PlyValues& values, const PlyElement& element) {
  if (element.properties.empty()) return;  // rows without bytes, however many
  for (std::int64_t row = 0; row < element.count; ++row) {
    values.go_to(element, row);
    for (const PlyProperty& property : element.properties) values.skip(property);
  }
}

}  // namespace

mesh::TriangleSoup ply_surface(std::string_view bytes, const std::string& name, double metres_per_unit) {
  require_metres_per_unit(metres_per_unit, name);
  PlyValues values(bytes, name);
  std::vector<Eigen::Vector3d> points;
  FacetList facets;
  for (const PlyElement& element : values.heading().elements) {
    if (element.name == "vertex" && points.empty()) {
      points = read_points(values, element, metres_per_unit);
    } else if (element.name == "face" && facets.ends.empty()) {
      facets = read_facets(values, element);
    } else if (element.name == "tristrips") {
      values.fail("triangle strips are not read; export faces");
    } else {
      skip_element(values, element);
    }
  }
  values.require_end();
  if (facets.ends.empty()) throw core::DataError(name + ": holds no facets; export the surface again, with faces");
  return triangles_of(std::move(points), facets, [&name](int row, const std::string& what) {
    throw core::DataError(name + ": face " + std::to_string(row) + ": " + what);
  });
}

mesh::TriangleSoup read_ply(const std::filesystem::path& path, double metres_per_unit) {
  return ply_surface(core::read_file(path), path.string(), metres_per_unit);
}

}  // namespace thinwall::io

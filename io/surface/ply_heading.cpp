#include "io/surface/ply_heading.hpp"

#include <array>
#include <limits>
#include <string_view>
#include <utility>

namespace thinwall::io {

namespace {

PlyType read_type(SurfaceText& text) {
  static constexpr std::array<std::pair<std::string_view, PlyType>, 16> names{{{"char", PlyType::int8},
                                                                               {"int8", PlyType::int8},
                                                                               {"uchar", PlyType::uint8},
                                                                               {"uint8", PlyType::uint8},
                                                                               {"short", PlyType::int16},
                                                                               {"int16", PlyType::int16},
                                                                               {"ushort", PlyType::uint16},
                                                                               {"uint16", PlyType::uint16},
                                                                               {"int", PlyType::int32},
                                                                               {"int32", PlyType::int32},
                                                                               {"uint", PlyType::uint32},
                                                                               {"uint32", PlyType::uint32},
                                                                               {"float", PlyType::float32},
                                                                               {"float32", PlyType::float32},
                                                                               {"double", PlyType::float64},
                                                                               {"float64", PlyType::float64}}};
  const std::string_view word = text.word_of_line();
  for (const auto& [name, type] : names)
    if (word == name) return type;
  text.fail(quoted(word) + " is no type of a PLY property");
}

PlyFormat read_format(SurfaceText& text) {
  const std::string_view word = text.word_of_line();
  if (word == "ascii") return PlyFormat::ascii;
  if (word == "binary_little_endian") return PlyFormat::little_endian;
  if (word == "binary_big_endian") return PlyFormat::big_endian;
  text.fail(quoted(word) + " is no format of PLY: ascii, binary_little_endian or binary_big_endian");
}

PlyElement read_element(SurfaceText& text) {
  PlyElement element;
  element.name = text.word_of_line();
  element.count = text.whole_number(text.word_of_line(), "the number of elements", 0, std::numeric_limits<int>::max());
  return element;
}

PlyProperty read_property(SurfaceText& text) {
  PlyProperty property;
  SurfaceText ahead = text;
  property.is_list = ahead.word_of_line() == "list";
  if (property.is_list) {
    text = std::move(ahead);
    property.count_type = read_type(text);
    if (property.count_type == PlyType::float32 || property.count_type == PlyType::float64)
      text.fail("the length of a list is a whole number, not a float");
  }
  property.type = read_type(text);
  property.name = text.word_of_line();
  return property;
}

}  // namespace

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
      return 4;
    case PlyType::float64:
      break;
  }
  return 8;
}

PlyHeading read_ply_heading(SurfaceText& text) {
  PlyHeading heading;
  if (text.word_of_line() != "ply") text.fail("a PLY file begins with \"ply\"");
  bool has_format = false;
  for (text.skip_line();; text.skip_line()) {
    const std::string_view keyword = text.word();
    if (keyword == "end_header") break;
    if (keyword == "format") {
      heading.format = read_format(text);
      has_format = true;
    } else if (keyword == "element") {
      heading.elements.push_back(read_element(text));
    } else if (keyword == "property") {
      if (heading.elements.empty()) text.fail("a property stands before the first element");
      heading.elements.back().properties.push_back(read_property(text));
    } else if (keyword.empty()) {
      text.fail("the heading ends without \"end_header\": the file is truncated");
    } else if (keyword != "comment" && keyword != "obj_info") {
      text.fail(quoted(keyword) + " does not belong into the heading of a PLY file");
    }
  }
  if (!has_format) text.fail("the heading has no line \"format ...\"");
  text.skip_line();
  return heading;
}

}  // namespace thinwall::io

#include "io/mesh/vtu_reader.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <pugixml.hpp>
#include <utility>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/mesh/vtu_array.hpp"
#include "io/surface_text.hpp"
#include "io/surface_unit.hpp"

namespace thinwall::io {

namespace {

/// A bound on the decoded bytes of a file. A mesh expands some fivefold; a file of compressed zeros may expand a
/// thousandfold.
std::uint64_t most_decoded_bytes(std::size_t file_size) {
  return (std::uint64_t{1} << 26U) + std::uint64_t{100} * file_size;
}

/// A solid cell of VTK, with the place in VTK's order of each node in the order of mesh/solid/cell_shape.hpp; an empty
/// list if both orders agree.
struct VtkSolid {
  mesh::CellShape shape = mesh::CellShape::tetrahedron;
  std::size_t nodes = 0;
  std::vector<std::size_t> order;
};

const std::map<std::int64_t, VtkSolid>& solids() {
  using mesh::CellShape;
  static const std::map<std::int64_t, VtkSolid> all{
      {10, {CellShape::tetrahedron, 4, {}}},
      {11, {CellShape::hexahedron, 8, {0, 1, 3, 2, 4, 5, 7, 6}}},
      {12, {CellShape::hexahedron, 8, {}}},
      {13, {CellShape::wedge, 6, {}}},
      {14, {CellShape::pyramid, 5, {}}},
      {24, {CellShape::tetrahedron, 10, {}}},
      {25, {CellShape::hexahedron, 20, {}}},
      {26, {CellShape::wedge, 15, {}}},
      {27, {CellShape::pyramid, 13, {}}},
      {29, {CellShape::hexahedron, 27, {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13,
                                        14, 15, 16, 17, 18, 19, 24, 25, 22, 21, 23, 20, 26}}},
      {32, {CellShape::wedge, 18, {}}}};
  return all;
}

/// True for cells of dimension 0 to 2, which a mesh of solids may contain too.
bool is_no_solid(std::int64_t type) {
  constexpr std::array<int, 19> flat{1, 2, 3, 4, 5, 6, 7, 8, 9, 21, 22, 23, 28, 30, 34, 36, 68, 69, 70};
  return std::find(flat.begin(), flat.end(), type) != flat.end();
}

class VtuReader {
 public:
  VtuReader(std::string_view bytes, const std::string& name, double metres_per_unit)
      : metres_per_unit_(metres_per_unit) {
    mesh_.path = name;
    mesh_.wedges_may_be_turned = true;
    encoding_.path = name;
    encoding_.most_bytes = most_decoded_bytes(bytes.size());
    const std::string xml = without_appended(bytes);
    const auto parsed = document_.load_buffer(xml.data(), xml.size());
    if (!parsed) fail(std::string("is no XML: ") + parsed.description() + " at byte " + std::to_string(parsed.offset));
  }

  mesh::LabelledMesh read() {
    const pugi::xml_node file = document_.child("VTKFile");
    if (!file) fail("has no element VTKFile");
    const std::string type = file.attribute("type").value();
    if (type != "UnstructuredGrid") fail("holds " + io::quoted(type) + ", not an UnstructuredGrid");
    encoding_.big_endian = file.attribute("byte_order").value() == std::string_view("BigEndian");
    encoding_.wide_header = file.attribute("header_type").value() == std::string_view("UInt64");
    const std::string compressor = file.attribute("compressor").value();
    encoding_.zlib = compressor == "vtkZLibDataCompressor";
    if (!compressor.empty() && !encoding_.zlib)
      fail("is compressed by " + io::quoted(compressor) + "; save it with zlib, or uncompressed");
    for (const pugi::xml_node piece : file.child("UnstructuredGrid").children("Piece")) read_piece(piece);
    if (passed_over_ > 0)
      mesh_.notices.push_back(std::to_string(passed_over_) + " cells that are no solids are passed over");
    for (auto& [set_name, labels] : sets_) mesh_.cell_sets.push_back({set_name, std::move(labels)});
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw core::DataError(mesh_.path + ": " + what); }

  /// The XML without the appended data, whose bytes may be invalid in XML.
  std::string without_appended(std::string_view bytes) {
    const auto tag = bytes.find("<AppendedData");
    if (tag == std::string_view::npos) return std::string(bytes);
    const auto close = bytes.find('>', tag);
    const auto begin = close == std::string_view::npos ? close : bytes.find('_', close);
    if (begin == std::string_view::npos) fail("ends within AppendedData");
    encoding_.appended = bytes.substr(begin + 1);
    if (const auto end = encoding_.appended.rfind("</AppendedData"); end != std::string_view::npos)
      encoding_.appended = encoding_.appended.substr(0, end);
    encoding_.appended_base64 = bytes.substr(tag, close - tag).find("base64") != std::string_view::npos;
    return std::string(bytes.substr(0, close + 1)) + "</AppendedData></VTKFile>";
  }

  static VtuArray array_of(const pugi::xml_node& node, const std::string& fallback) {
    VtuArray array;
    array.name = node.attribute("Name").as_string(fallback.c_str());
    array.type = node.attribute("type").value();
    array.format = node.attribute("format").as_string("ascii");
    array.offset = node.attribute("offset").as_ullong();
    array.text = node.child_value();
    return array;
  }

  /// The numbers of an array, with a bound on the decoded bytes of all arrays together.
  template <class T>
  std::vector<T> accounted(std::vector<T> values) {
    decoded_bytes_ += values.size() * sizeof(T);
    if (decoded_bytes_ > encoding_.most_bytes)
      fail("decodes to more than " + std::to_string(encoding_.most_bytes) + " bytes");
    return values;
  }

  std::vector<std::int64_t> cell_array(const pugi::xml_node& cells, const char* name) {
    const pugi::xml_node node = cells.find_child_by_attribute("DataArray", "Name", name);
    if (!node) fail(std::string("a piece lacks the array \"") + name + "\" of its cells");
    return accounted(vtu_integers(encoding_, array_of(node, name)));
  }

  void read_piece(const pugi::xml_node& piece) {
    const auto points = static_cast<std::int64_t>(read_points(piece));
    const pugi::xml_node cells = piece.child("Cells");
    const auto connectivity = cell_array(cells, "connectivity");
    const auto offsets = cell_array(cells, "offsets");
    const auto types = cell_array(cells, "types");
    if (types.size() != offsets.size() || types.size() != piece.attribute("NumberOfCells").as_ullong())
      fail("a piece of " + std::string(piece.attribute("NumberOfCells").value()) + " cells has " +
           std::to_string(offsets.size()) + " offsets and " + std::to_string(types.size()) + " types");
    std::int64_t begin = 0;
    for (std::size_t c = 0; c < types.size(); ++c) {
      const std::int64_t end = offsets[c];
      if (end < begin || end > static_cast<std::int64_t>(connectivity.size()))
        fail("the offset of cell " + std::to_string(first_cell_ + static_cast<std::int64_t>(c)) + " is " +
             std::to_string(end) + "; from " + std::to_string(begin) + " to " + std::to_string(connectivity.size()) +
             " fits");
      const auto nodes = connectivity.data() + begin;
      add_cell(first_cell_ + static_cast<std::int64_t>(c), types[c], {nodes, static_cast<std::size_t>(end - begin)},
               points);
      begin = end;
    }
    read_cell_data(piece, types);
    first_point_ += points;
    first_cell_ += static_cast<std::int64_t>(types.size());
  }

  std::size_t read_points(const pugi::xml_node& piece) {
    const pugi::xml_node node = piece.child("Points").child("DataArray");
    if (!node) fail("a piece lacks its Points");
    const std::vector<double> x = accounted(vtu_reals(encoding_, array_of(node, "Points")));
    const auto count = piece.attribute("NumberOfPoints").as_ullong();
    if (x.size() % 3 != 0 || x.size() / 3 != count || node.attribute("NumberOfComponents").as_int(3) != 3)
      fail("a piece of " + std::to_string(count) + " points has " + std::to_string(x.size()) + " coordinates");
    for (std::size_t i = 0; i < count; ++i)
      mesh_.nodes.push_back({first_point_ + static_cast<std::int64_t>(i), 0,
                             metres_per_unit_ * Eigen::Vector3d(x[3 * i], x[3 * i + 1], x[3 * i + 2])});
    return count;
  }

  struct CellNodes {
    const std::int64_t* begin;
    std::size_t count;
  };

  void add_cell(std::int64_t label, std::int64_t type, CellNodes nodes, std::int64_t points) {
    if (is_no_solid(type)) {
      ++passed_over_;
      return;
    }
    if (type == 71) type = nodes.count == 4 ? 10 : nodes.count == 10 ? 24 : type;  // Lagrange of order 1 and 2
    const auto found = solids().find(type);
    const std::string cell = "cell " + std::to_string(label);
    if (found == solids().end())
      fail(cell + " of VTK's type " + std::to_string(type) + " with " + std::to_string(nodes.count) +
           " nodes is not read: tetrahedra, hexahedra, wedges and pyramids of order 1 and 2 are");
    const VtkSolid& solid = found->second;
    if (nodes.count != solid.nodes)
      fail(cell + " has " + std::to_string(nodes.count) + " nodes, its type " + std::to_string(solid.nodes));
    mesh_.cells.push_back({label, 0, solid.shape, mesh_.cell_nodes.size(), solid.nodes});
    for (std::size_t a = 0; a < solid.nodes; ++a) {
      const std::int64_t node = nodes.begin[solid.order.empty() ? a : solid.order[a]];
      if (node < 0 || node >= points)
        fail(cell + " names point " + std::to_string(node) + " of " + std::to_string(points));
      mesh_.cell_nodes.push_back(first_point_ + node);
    }
  }

  void read_cell_data(const pugi::xml_node& piece, const std::vector<std::int64_t>& types) {
    constexpr std::size_t most_values = 1000;
    for (const pugi::xml_node node : piece.child("CellData").children("DataArray")) {
      const VtuArray array = array_of(node, "cell data");
      const bool is_integer = array.type.find("Int") != std::string::npos;
      if (!is_integer || node.attribute("NumberOfComponents").as_int(1) != 1) continue;
      const std::vector<std::int64_t> values = accounted(vtu_integers(encoding_, array));
      if (values.size() != types.size())
        fail("the cell data " + io::quoted(array.name) + " have " + std::to_string(values.size()) + " values for " +
             std::to_string(types.size()) + " cells");
      std::map<std::int64_t, std::vector<std::int64_t>> by_value;
      for (std::size_t c = 0; c < values.size() && by_value.size() <= most_values; ++c)
        if (!is_no_solid(types[c])) by_value[values[c]].push_back(first_cell_ + static_cast<std::int64_t>(c));
      if (by_value.size() > most_values) continue;
      for (const auto& [value, labels] : by_value) {
        auto& set = sets_[array.name + "=" + std::to_string(value)];
        set.insert(set.end(), labels.begin(), labels.end());
      }
    }
  }

  double metres_per_unit_;
  pugi::xml_document document_;
  VtuEncoding encoding_;
  mesh::LabelledMesh mesh_;
  std::map<std::string, std::vector<std::int64_t>> sets_;
  std::int64_t first_point_ = 0;
  std::int64_t first_cell_ = 0;
  std::int64_t passed_over_ = 0;
  std::uint64_t decoded_bytes_ = 0;
};

}  // namespace

mesh::LabelledMesh vtu_mesh(std::string_view bytes, const std::string& name, double metres_per_unit) {
  require_metres_per_unit(metres_per_unit, name);
  return VtuReader(bytes, name, metres_per_unit).read();
}

mesh::SolidMesh read_vtu(const std::filesystem::path& path, double metres_per_unit) {
  return mesh::solid_mesh(vtu_mesh(core::read_file(path), path.string(), metres_per_unit));
}

}  // namespace thinwall::io

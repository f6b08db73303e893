#include "io/surface/three_mf.hpp"

#include <Eigen/Geometry>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <pugixml.hpp>
#include <utility>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/surface/zip_archive.hpp"
#include "io/surface_text.hpp"

namespace thinwall::io {

namespace {

constexpr int deepest = 32;
constexpr std::size_t most_triangles = 20'000'000, most_objects = 100'000;

/// The model's text, or the file's name and a fault.
struct ModelSource {
  const std::string& name;

  [[noreturn]] void fail(const std::string& what) const { throw core::DataError(name + ": " + what); }
};

struct Unit {
  const char* word;
  const char* symbol;
  double metres;
};
constexpr std::array units{Unit{"micron", "um", 1e-6},   Unit{"millimeter", "mm", 1e-3}, Unit{"centimeter", "cm", 1e-2},
                           Unit{"inch", "inch", 0.0254}, Unit{"foot", "ft", 0.3048},     Unit{"meter", "m", 1.0}};

Unit unit_of(const pugi::xml_node& model, const ModelSource& source) {
  const std::string word = model.attribute("unit").as_string("millimeter");
  for (const Unit& unit : units) {
    if (word == unit.word) return unit;
  }
  source.fail("the unit " + io::quoted(word) + " is none of micron, millimeter, centimeter, inch, foot, meter");
}

template <class Number>
Number number_of(const pugi::xml_node& node, const char* attribute, const ModelSource& source) {
  const char* text = node.attribute(attribute).as_string();
  Number value{};
  const auto [end, error] = std::from_chars(text, text + std::strlen(text), value);
  const bool finite = std::isfinite(static_cast<double>(value));
  if (error != std::errc() || *end != '\0' || !finite)
    source.fail(std::string("<") + node.name() + "> has " + io::quoted(text) + " as " + attribute +
                ", which is no number");
  return value;
}

/// The transform of a component or of an item: twelve numbers, rows of a matrix that acts on rows.
Eigen::Affine3d transform_of(const pugi::xml_node& node, const ModelSource& source) {
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  const std::string text = node.attribute("transform").as_string();
  if (text.empty()) return transform;
  const char* at = text.c_str();
  const char* const end = at + text.size();
  for (Eigen::Index row = 0; row < 4; ++row) {
    for (Eigen::Index column = 0; column < 3; ++column) {
      while (*at == ' ' || *at == '\t' || *at == '\n' || *at == '\r') ++at;
      double value = 0.0;
      const auto [next, error] = std::from_chars(at, end, value);
      if (error != std::errc() || !std::isfinite(value))
        source.fail("a transform is not of twelve numbers: " + io::quoted(text));
      transform.matrix()(column, row) = value;
      at = next;
    }
  }
  return transform;
}

class Model {
 public:
  Model(const pugi::xml_node& model, const ModelSource& source, double metres) : source_(source), metres_(metres) {
    for (const pugi::xml_node& object : model.child("resources").children("object")) {
      const std::string id = object.attribute("id").as_string();
      if (!objects_.emplace(id, object).second) source_.fail("two objects have the id " + io::quoted(id));
    }
    for (const pugi::xml_node& item : model.child("build").children("item"))
      place(item, Eigen::Affine3d::Identity(), 0);
  }

  mesh::TriangleSoup take() { return std::move(soup_); }

 private:
  /// Adds the object that a component or an item names.
  void place(const pugi::xml_node& node, const Eigen::Affine3d& parent, int depth) {
    const std::string id = node.attribute("objectid").as_string();
    const std::string what = "the object " + io::quoted(id);
    if (node.attribute("p:path")) source_.fail(what + " lies in another file of the archive, which is not read");
    const auto found = objects_.find(id);
    if (found == objects_.end()) source_.fail(what + " is not there");
    if (++placed_ > most_objects) source_.fail("more than " + std::to_string(most_objects) + " objects are placed");
    if (depth > deepest)
      source_.fail(what + " holds itself, or objects are nested deeper than " + std::to_string(deepest));
    const pugi::xml_node& object = found->second;
    const std::string type = object.attribute("type").as_string("model");
    if (type != "model" && type != "solidsupport" && type != "surface" && type != "other" && type != "support")
      source_.fail(what + " is of the unknown type " + io::quoted(type));
    if (type == "support" || type == "solidsupport" || type == "other") return;
    const Eigen::Affine3d frame = parent * transform_of(node, source_);
    if (const pugi::xml_node mesh = object.child("mesh")) add(mesh, frame);
    for (const pugi::xml_node& component : object.child("components").children("component"))
      place(component, frame, depth + 1);
  }

  void add(const pugi::xml_node& mesh, const Eigen::Affine3d& frame) {
    const auto first = static_cast<int>(soup_.points.size());
    int vertices = 0;
    for (const pugi::xml_node& vertex : mesh.child("vertices").children("vertex")) {
      const Eigen::Vector3d x(number_of<double>(vertex, "x", source_), number_of<double>(vertex, "y", source_),
                              number_of<double>(vertex, "z", source_));
      soup_.points.emplace_back(metres_ * (frame * x));
      if (!soup_.points.back().allFinite()) source_.fail("a vertex lies beyond the range of a double");
      ++vertices;
    }
    const bool mirrored = frame.linear().determinant() < 0.0;
    for (const pugi::xml_node& triangle : mesh.child("triangles").children("triangle")) {
      std::array<int, 3> corners{number_of<int>(triangle, "v1", source_), number_of<int>(triangle, "v2", source_),
                                 number_of<int>(triangle, "v3", source_)};
      for (int& corner : corners) {
        if (corner < 0 || corner >= vertices)
          source_.fail("a triangle names vertex " + std::to_string(corner) + " of " + std::to_string(vertices));
        corner += first;
      }
      if (mirrored) std::swap(corners[1], corners[2]);
      soup_.triangles.push_back(corners);
    }
    if (soup_.triangles.size() > most_triangles || soup_.points.size() > most_triangles)
      source_.fail("more than " + std::to_string(most_triangles) + " triangles or points");
  }

  const ModelSource& source_;
  double metres_;
  std::map<std::string, pugi::xml_node> objects_;
  mesh::TriangleSoup soup_;
  std::size_t placed_ = 0;
};

/// The text of the archive's model.
std::string model_text(std::string_view bytes, const ModelSource& source) {
  const auto entries = zip_entries(bytes, source.name);
  const ZipEntry* found = nullptr;
  for (const ZipEntry& entry : entries) {
    const std::string name = lower_case(entry.name);
    if (name == "3d/3dmodel.model") return zip_contents(entry, source.name);
    if (name.ends_with(".model") && found == nullptr) found = &entry;
  }
  if (found == nullptr) source.fail("the archive holds no model (3D/3dmodel.model): no 3MF file");
  return zip_contents(*found, source.name);
}

}  // namespace

ThreeMfSurface three_mf_surface(std::string_view bytes, const std::string& name) {
  const ModelSource source{name};
  std::string text = model_text(bytes, source);
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer_inplace(text.data(), text.size());
  if (!parsed) source.fail(std::string("the model is no XML: ") + parsed.description());
  const pugi::xml_node model = document.child("model");
  if (!model) source.fail("the model has no <model>");
  const Unit unit = unit_of(model, source);
  ThreeMfSurface result{Model(model, source, unit.metres).take(), unit.symbol, unit.metres};
  if (result.soup.triangles.empty()) source.fail("the build places no object with triangles");
  return result;
}

ThreeMfSurface read_three_mf(const std::filesystem::path& path) {
  return three_mf_surface(core::read_file(path), path.string());
}

}  // namespace thinwall::io

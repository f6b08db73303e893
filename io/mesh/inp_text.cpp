#include "io/mesh/inp_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "io/surface_text.hpp"

namespace thinwall::io {

namespace {

/// The kind of data in the lines after a keyword.
enum class Section {
  passed_over,
  counted,  ///< elements that are skipped and counted
  nodes,
  elements,
  set,
  generated_set,
  surface,
  elastic,
  density,
  instance
};

/// A type of element that is read.
struct InpElement {
  mesh::CellShape shape = mesh::CellShape::tetrahedron;
  std::size_t nodes = 0;  ///< 0: none
};

/// The element of a type C3D4, C3D10 …, with any letters behind (R: reduced integration, H: hybrid, I, M, S, T:
/// variants).
InpElement element_of_type(std::string_view type) {
  if (!type.starts_with("C3D")) return {};
  std::size_t nodes = 0;
  for (const char c : type.substr(3)) {
    if (c < '0' || c > '9' || nodes > 100) break;
    nodes = 10 * nodes + static_cast<std::size_t>(c - '0');
  }
  using mesh::CellShape;
  for (const CellShape shape : {CellShape::tetrahedron, CellShape::hexahedron, CellShape::wedge, CellShape::pyramid})
    if (nodes != 27 && nodes != 18 && nodes != 14 && mesh::cell_order(shape, nodes) > 0) return {shape, nodes};
  return {};
}

/// A reader of a file line by line.
class InpReader {
  using Parameters = std::map<std::string, std::string>;

 public:
  InpReader(std::string_view bytes, const std::string& name, double metres_per_unit, const InpInclude& include)
      : metres_per_unit_(metres_per_unit) {
    result_.mesh.path = name;
    lines_.emplace(bytes, include, result_.mesh);
  }

  InpText read() {
    for (std::string_view line; lines_->next(line);) {
      line_ = lines_->number();
      if (line.front() == '*' || keyword_goes_on_) {
        read_keyword(line);
      } else {
        read_data(line);
      }
    }
    require_whole_element();
    for (const auto& [type, count] : passed_over_)
      result_.mesh.notices.push_back(std::to_string(count) + " elements of type " + type +
                                     " are no solids and are passed over");
    if (omitted_ > 0)
      result_.mesh.notices.push_back(std::to_string(omitted_) +
                                     " nodes have fewer than three coordinates (the first: " +
                                     mesh::place_of(result_.mesh, first_omitted_) + "); those left out are 0");
    result_.included = lines_->included();
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { mesh::fail_at(result_.mesh, line_, what); }

  /// Reads a keyword, whose line continues in the next one if it ends with a comma.
  void read_keyword(std::string_view line) {
    if (!keyword_goes_on_) keyword_.clear();
    keyword_ += line;
    keyword_goes_on_ = line.back() == ',';
    if (keyword_goes_on_) return;
    std::string_view rest = keyword_;
    const std::string name = capitals(next_field(rest));
    Parameters parameters;
    while (!rest.empty()) {
      const std::string_view field = next_field(rest);
      const auto equals = std::min(field.find('='), field.size());
      std::string_view value = without_blanks(field.substr(std::min(equals + 1, field.size())));
      if (value.size() > 1 && value.front() == '"' && value.back() == '"') value = value.substr(1, value.size() - 2);
      parameters[capitals(without_blanks(field.substr(0, equals)))] = value;
    }
    if (name == "*INCLUDE") return lines_->include(parameters["INPUT"]);  // its lines may go on with this section
    require_whole_element();
    for (auto& [parameter, value] : parameters) value = capitals(value);
    open_section(name, parameters);
  }

  void open_section(const std::string& name, Parameters& parameters) {
    section_ = Section::passed_over;
    set_ = nullptr;
    require_no_maker(name);
    if (name == "*NODE") {
      section_ = Section::nodes;
      if (parameters.contains("INPUT") || parameters.contains("SYSTEM"))
        fail("*NODE is read without INPUT= and SYSTEM=: write the nodes here, in Cartesian coordinates");
      if (parameters.contains("NSET")) set_ = &result_.node_sets[parameters["NSET"]];
    } else if (name == "*ELEMENT") {
      open_elements(parameters);
    } else if (name == "*NSET") {
      if (parameters.contains("ELSET")) fail("*NSET is read without ELSET=: write the numbers of the nodes");
      open_set(parameters, "NSET", result_.node_sets);
    } else if (name == "*ELSET") {
      open_set(parameters, "ELSET", result_.element_sets);
    } else if (name == "*SURFACE") {
      open_surface(parameters);
    } else if (name == "*INSTANCE") {
      section_ = Section::instance;
    } else {
      open_material(name, parameters);
    }
  }

  void require_no_maker(const std::string& name) const {
    for (const char* maker : {"*SYSTEM", "*NGEN", "*NFILL", "*NCOPY", "*NMAP", "*ELGEN", "*ELCOPY"}) {
      if (name == maker) {
        fail(name + " is not read, and without it the mesh would be another one: have the program that writes the " +
             "file write all nodes and elements");
      }
    }
  }

  void open_elements(Parameters& parameters) {
    const std::string type = parameters["TYPE"];
    element_ = element_of_type(type);
    if (element_.nodes == 0) {
      if (type.empty() || type.starts_with("C3D"))
        fail("elements of type " + io::quoted(type) +
             " are not read; C3D4, C3D10, C3D8, C3D20, C3D6, C3D15 and C3D5 are");
      section_ = Section::counted;
      flat_count_ = &passed_over_[io::quoted(type)];
      flat_goes_on_ = false;
    } else {
      section_ = Section::elements;
    }
    if (!parameters["ELSET"].empty()) set_ = &result_.element_sets[parameters["ELSET"]];
  }

  void open_set(Parameters& parameters, const std::string& kind, std::map<std::string, InpTextSet>& sets) {
    if (parameters[kind].empty()) fail("*" + kind + " lacks " + kind + "=name");
    section_ = parameters.contains("GENERATE") ? Section::generated_set : Section::set;
    sets_ = &sets;
    set_ = &sets[parameters[kind]];
  }

  /// Opens a surface: lines of surfaces of nodes contain a number or a set, those of elements also a face.
  void open_surface(Parameters& parameters) {
    const std::string type = parameters["TYPE"];
    if (parameters["NAME"].empty() || (!type.empty() && type != "ELEMENT" && type != "NODE")) return;
    if (parameters.contains("COMBINE")) return;
    section_ = Section::surface;
    surface_of_nodes_ = type == "NODE";
    surface_ = &result_.surfaces[parameters["NAME"]];
  }

  void open_material(const std::string& name, Parameters& parameters) {
    if (name == "*MATERIAL") result_.materials.push_back({parameters["NAME"], {}, {}, {}});
    if (name == "*SOLID SECTION") result_.sections.push_back({parameters["ELSET"], parameters["MATERIAL"], line_});
    if (result_.materials.empty()) return;
    const std::string type = parameters["TYPE"];
    if (name == "*ELASTIC" && !result_.materials.back().youngs_modulus) {
      if (type.empty() || type == "ISO" || type == "ISOTROPIC") {
        section_ = Section::elastic;
      } else {
        result_.mesh.notices.push_back("material " + io::quoted(result_.materials.back().name) +
                                       " is not isotropic: " + "its *ELASTIC is passed over");
      }
    }
    if (name == "*DENSITY" && !result_.materials.back().density) section_ = Section::density;
  }

  void read_data(std::string_view line) {
    if (section_ == Section::nodes) read_node(line);
    if (section_ == Section::elements) read_element(line);
    if (section_ == Section::set) read_set(line);
    if (section_ == Section::generated_set) read_generated_set(line);
    if (section_ == Section::surface) read_face(line);
    if (section_ == Section::counted) read_flat(line);
    if (section_ == Section::elastic || section_ == Section::density) read_constants(line);
    if (section_ == Section::instance)
      fail("an *INSTANCE that moves its part is not read: write the part alone, where it belongs");
  }

  void read_node(std::string_view rest) {
    mesh::LabelledNode node{next_label(rest), line_, Eigen::Vector3d::Zero()};
    bool omitted = false;
    for (int i = 0; i < 3; ++i) {
      const std::string_view field = next_field(rest);
      omitted = omitted || field.empty();
      if (!field.empty()) node.x(i) = metres_per_unit_ * number(field);
    }
    if (omitted && omitted_++ == 0) first_omitted_ = line_;
    if (!rest.empty()) fail("a node has a number and three coordinates; " + io::quoted(rest) + " is beyond them");
    if (set_ != nullptr) set_->ranges.push_back({node.label, node.label, 1, line_, false});
    result_.mesh.nodes.push_back(node);
  }

  /// Reads a line of an element, which may take several lines until it has all its nodes.
  void read_element(std::string_view rest) {
    mesh::LabelledMesh& mesh = result_.mesh;
    if (nodes_missing_ == 0) {
      const auto label = next_label(rest);
      mesh.cells.push_back({label, line_, element_.shape, mesh.cell_nodes.size(), element_.nodes});
      nodes_missing_ = element_.nodes;
      if (set_ != nullptr) set_->ranges.push_back({label, label, 1, line_, false});
    }
    while (!rest.empty()) {
      if (nodes_missing_ == 0)
        fail("more than " + std::to_string(element_.nodes) + " nodes in element " +
             std::to_string(mesh.cells.back().label));
      mesh.cell_nodes.push_back(next_label(rest));
      --nodes_missing_;
    }
  }

  /// Reads a line of an element that is no solid, which continues after a comma; words that are no numbers are skipped.
  void read_flat(std::string_view rest) {
    const bool goes_on = rest.back() == ',';
    if (!flat_goes_on_) {
      const auto label = next_label(rest);
      result_.flat.push_back({label, result_.flat_nodes.size(), 0});
      ++*flat_count_;
      if (set_ != nullptr) set_->ranges.push_back({label, label, 1, line_, false});
    }
    flat_goes_on_ = goes_on;
    while (!rest.empty()) {
      const std::string_view field = next_field(rest);
      std::int64_t node = 0;
      if (std::from_chars(field.data(), field.data() + field.size(), node).ec != std::errc{}) continue;
      result_.flat_nodes.push_back(node);
      ++result_.flat.back().nodes;
    }
  }

  void require_whole_element() const {
    if (nodes_missing_ == 0) return;
    const mesh::LabelledCell& cell = result_.mesh.cells.back();
    mesh::fail_at(
        result_.mesh, cell.line,
        "element " + std::to_string(cell.label) + " lacks " + std::to_string(nodes_missing_) + " of its nodes");
  }

  static bool is_name(std::string_view field) {
    return (field.front() < '0' || field.front() > '9') && field.front() != '-' && field.front() != '+';
  }

  void read_set(std::string_view rest) {
    while (!rest.empty()) {
      std::string_view field = next_field(rest);
      if (field.empty()) continue;
      if (is_name(field)) {
        const std::string other = capitals(field);
        if (!sets_->contains(other)) fail("the set " + io::quoted(other) + " is not defined above this line");
        set_->others.push_back(other);
      } else {
        const auto label = next_label(field);
        set_->ranges.push_back({label, label, 1, line_, false});
      }
    }
  }

  void read_generated_set(std::string_view rest) {
    InpLabelRange range{next_label(rest), 0, 1, line_, true};
    range.last = next_label(rest);
    if (!rest.empty()) range.step = next_label(rest);
    if (range.last < range.first)
      fail("a range from " + std::to_string(range.first) + " down to " + std::to_string(range.last) +
           ": write the smaller number first");
    set_->ranges.push_back(range);
  }

  void read_face(std::string_view rest) {
    std::string_view field = next_field(rest);
    if (field.empty()) return;
    InpTextFace face{{}, 0, 0, line_};
    if (is_name(field)) face.set = capitals(field);
    if (!is_name(field)) face.label = next_label(field);
    if (!surface_of_nodes_) {
      const std::string name = capitals(next_field(rest));
      const bool numbered = name.size() == 2 && name[0] == 'S' && name[1] >= '1' && name[1] <= '6';
      if (!numbered && name != "SPOS" && name != "SNEG")
        fail("the face " + io::quoted(name) + " of a surface is not read; S1 to S6, SPOS and SNEG are");
      face.face = numbered ? name[1] - '0' : whole_shell;
    }
    surface_->push_back(face);
  }

  /// Reads the first line of *ELASTIC or *DENSITY; later lines are for other temperatures.
  void read_constants(std::string_view rest) {
    InpTextMaterial& material = result_.materials.back();
    if (section_ == Section::elastic) {
      material.youngs_modulus = next_number(rest);
      material.poisson_ratio = next_number(rest);
    } else {
      material.density = next_number(rest);
    }
    section_ = Section::passed_over;
  }

  /// Takes the text up to the next comma off `rest`.
  static std::string_view next_field(std::string_view& rest) {
    const auto comma = std::min(rest.find(','), rest.size());
    const std::string_view field = without_blanks(rest.substr(0, comma));
    rest.remove_prefix(std::min(comma + 1, rest.size()));
    return field;
  }

  std::int64_t next_label(std::string_view& rest) const {
    const std::string_view field = next_field(rest);
    int label = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), label);
    if (error != std::errc{} || end != field.data() + field.size() || label < 1) {
      fail(io::quoted(field) + " where a whole number from 1 to 2147483647 belongs");
    }
    return label;
  }

  double next_number(std::string_view& rest) const { return number(next_field(rest)); }

  /// The field as a number, also in Fortran's forms "1.5D-3" and "+1.5".
  double number(std::string_view field) const {
    double value = std::nan("");
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error == std::errc{} && end == field.data() + field.size() && std::isfinite(value)) return value;
    std::string text(field.substr(field.starts_with('+') ? 1 : 0));
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == 'd' || c == 'D'; }, 'e');
    const auto [text_end, text_error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text_error != std::errc{} || text_end != text.data() + text.size() || !std::isfinite(value)) {
      fail(io::quoted(field) + " where a finite number belongs");
    }
    return value;
  }

  double metres_per_unit_ = 0.0;
  InpText result_;
  std::optional<InpLines> lines_;
  Section section_ = Section::passed_over;
  InpElement element_;
  InpTextSet* set_ = nullptr;                          ///< the set that the section adds to
  std::map<std::string, InpTextSet>* sets_ = nullptr;  ///< where its parts are looked up
  std::vector<InpTextFace>* surface_ = nullptr;
  bool surface_of_nodes_ = false;
  std::map<std::string, int> passed_over_;  ///< number of skipped elements of each type
  int* flat_count_ = nullptr;
  bool flat_goes_on_ = false;
  std::string keyword_;
  bool keyword_goes_on_ = false;
  std::size_t nodes_missing_ = 0;  ///< nodes that the last element still lacks
  int line_ = 0;
  int omitted_ = 0;  ///< nodes that lack a coordinate
  int first_omitted_ = 0;
};

}  // namespace

InpText inp_text(std::string_view bytes, const std::string& name, double metres_per_unit, const InpInclude& include) {
  return InpReader(bytes, name, metres_per_unit, include).read();
}

std::string capitals(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return result;
}

}  // namespace thinwall::io

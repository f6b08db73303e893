#include "io/mesh/gmsh.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "core/atomic_file.hpp"
#include "io/mesh/gmsh_element.hpp"
#include "io/mesh/gmsh_numbers.hpp"
#include "io/surface_unit.hpp"

namespace thinwall::io {

namespace {

constexpr std::int64_t any = std::numeric_limits<std::int32_t>::max();
constexpr std::int64_t most_groups = 64;  ///< of an entity, because every element is stored once in each group
constexpr std::int64_t many = std::numeric_limits<std::int64_t>::max() / 2;
using Group = std::pair<std::int64_t, std::int64_t>;  ///< dimension, tag

class GmshReader {
 public:
  GmshReader(std::string_view bytes, const std::string& name, double metres_per_unit)
      : in_(bytes, name), metres_per_unit_(metres_per_unit) {
    mesh_.path = name;
  }

  mesh::LabelledMesh read() {
    read_format();
    while (!in_.text().at_end()) read_section(std::string(in_.text().word()));
    if (mesh_.nodes.empty()) in_.fail("the file ends without $Nodes");
    add_sets();
    return std::move(mesh_);
  }

 private:
  void read_format() {
    SurfaceText& text = in_.text();
    while (text.rest().starts_with("$Comments")) pass_section("$Comments");
    if (text.rest().starts_with("$NOD")) {  // MSH 1, which has no head
      is_2_ = mesh_.repeated_cells_are_one = true;
      return;
    }
    if (text.word() != "$MeshFormat") in_.fail("the file does not begin with $MeshFormat: no mesh of Gmsh");
    const std::string version(text.word());
    const bool is_binary = text.whole_number("the file type, 0 or 1,", 0, 1) == 1;
    if (text.whole_number("the size of a real", 1, 1000) != 8) in_.fail("reals of other than 8 bytes are not read");
    is_2_ = version.starts_with("2");
    is_3_ = version.starts_with("3");
    is_40_ = version == "4" || version == "4.0";
    if (!is_2_ && !is_3_ && !is_40_ && version != "4.1")
      in_.fail("MSH version " + io::quoted(version) + " is not read; save the mesh as version 2.2 or 4.1");
    if (is_40_ && is_binary) in_.fail("MSH 4.0 is read as text only; save the mesh as version 4.1");
    text.skip_line();
    if (is_binary) in_.begin_binary();
    mesh_.repeated_cells_are_one = is_2_;
    require_end("$MeshFormat");
  }

  void require_end(const std::string& section) {
    const std::string_view found = in_.text().word();
    const std::string end = (section == "$NOD" || section == "$ELM" ? "$END" : "$End") + section.substr(1);
    if (found != end) in_.fail(io::quoted(found) + " where " + end + " belongs: the section's counts do not fit");
    in_.text().skip_line();
  }

  void read_section(const std::string& name) {
    if (name == "$PhysicalNames") {
      read_names();
    } else if (name == "$Entities" && !is_2_) {
      in_.text().skip_line();
      is_3_ ? read_entities_3() : read_entities();
    } else if (name == "$Nodes" || name == "$NOD" || (name == "$ParametricNodes" && is_2_)) {
      is_3_ ? read_nodes_3() : is_2_ ? read_nodes_2(name == "$ParametricNodes") : read_nodes_4();
    } else if (name == "$Elements") {
      is_3_ ? read_elements_3() : is_2_ ? read_elements_2() : read_elements_4();
    } else if (name == "$ELM") {
      read_elements_1();
    } else if (name.starts_with("$")) {
      if (name == "$PartitionedEntities")
        mesh_.notices.emplace_back("the mesh is partitioned: its physical groups are not read");
      pass_section(name);
      return;
    } else {
      in_.fail(io::quoted(name) + " where a section belongs");
    }
    require_end(name);
  }

  void pass_section(const std::string& name) {
    const std::string end = "$End" + name.substr(1);
    const auto found = in_.text().rest().find(end);
    if (found == std::string_view::npos) in_.fail("the file ends within " + io::quoted(name));
    static_cast<void>(in_.text().take(found + end.size()));
    in_.text().skip_line();
  }

  void read_names() {
    SurfaceText& text = in_.text();
    const auto count = text.whole_number("the number of names", 0, any);
    for (std::int64_t i = 0; i < count; ++i) {
      const auto dimension = text.whole_number("the dimension of a group", 0, 3);
      const auto tag = text.whole_number("the number of a group", -any, any);
      const auto line = text.take(std::min(text.rest().find('\n'), text.rest().size()));
      const auto begin = line.find('"');
      const auto end = line.rfind('"');
      if (begin == std::string_view::npos || begin == end) in_.fail("the name of a group lacks its quotes");
      names_[{dimension, tag}] = std::string(line.substr(begin + 1, end - begin - 1));
    }
  }

  /// Reads the physical groups of each entity of the geometry.
  void read_entities() {
    std::array<std::int64_t, 4> counts{};
    for (auto& count : counts) count = in_.count("a number of entities", 0, many);
    for (std::int64_t dimension = 0; dimension < 4; ++dimension) {
      for (std::int64_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) read_entity(dimension);
    }
  }

  void read_entity(std::int64_t dimension) {
    const auto tag = in_.integer("the number of an entity", -any, any);
    const int reals = dimension == 0 && !is_40_ ? 3 : 6;
    for (int k = 0; k < reals; ++k) static_cast<void>(in_.real("a bound of an entity"));
    const auto groups = in_.count("a number of physical groups", 0, most_groups);
    for (std::int64_t g = 0; g < groups; ++g) {
      const auto group = in_.integer("the number of a group", -any, any);
      groups_of_entity_[{dimension, tag}].insert(group < 0 ? -group : group);
    }
    if (dimension == 0) return;
    const auto parts = in_.count("a number of bounding entities", 0, many);
    for (std::int64_t p = 0; p < parts; ++p) static_cast<void>(in_.integer("a bounding entity", -any, any));
  }

  /// Reads the physical groups of each entity, which are text in binary files, too.
  void read_entities_3() {
    SurfaceText& text = in_.text();
    std::array<std::int64_t, 4> counts{};
    for (auto& count : counts) count = text.whole_number("a number of entities", 0, any);
    for (std::int64_t dimension = 0; dimension < 4; ++dimension) {
      for (std::int64_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) {
        const auto tag = text.whole_number("the number of an entity", -any, any);
        const auto parts = dimension == 0 ? 0 : text.whole_number("a number of bounding entities", 0, any);
        for (std::int64_t p = 0; p < parts; ++p) static_cast<void>(text.whole_number("a bounding entity", -any, any));
        const auto groups = text.whole_number("a number of physical groups", 0, most_groups);
        for (std::int64_t g = 0; g < groups; ++g)
          groups_of_entity_[{dimension, tag}].insert(std::abs(text.whole_number("the number of a group", -any, any)));
      }
    }
  }

  Eigen::Vector3d position() {
    Eigen::Vector3d x;
    for (Eigen::Index k = 0; k < 3; ++k) x(k) = metres_per_unit_ * in_.real("a coordinate");
    return x;
  }

  void read_nodes_2(bool parametric) {
    if (parametric && in_.is_binary()) in_.fail("$ParametricNodes are read as text only; save the mesh as version 4.1");
    const auto count = in_.text().whole_number("the number of nodes", 0, any);
    in_.text().skip_line();
    for (std::int64_t i = 0; i < count; ++i) {
      const auto label = in_.integer("the number of a node", 1, any);
      const auto line = in_.line();
      mesh_.nodes.push_back({label, line, position()});
      if (parametric) in_.text().skip_line();
    }
  }

  /// Reads nodes with the entity on which each lies, 0 for none, its dimension and as many parameters.
  void read_nodes_3() {
    const auto count = in_.text().whole_number("the number of nodes", 0, any);
    in_.text().skip_line();
    for (std::int64_t i = 0; i < count; ++i) {
      const auto label = in_.integer("the number of a node", 1, any);
      const auto line = in_.line();
      mesh_.nodes.push_back({label, line, position()});
      if (in_.integer("the entity of a node", -any, any) == 0) continue;
      const auto parameters = in_.integer("the dimension of a node's entity", 0, 3);
      for (std::int64_t k = 0; k < parameters; ++k) static_cast<void>(in_.real("a parameter of a node"));
    }
  }

  void read_nodes_4() {
    in_.text().skip_line();
    const auto blocks = in_.count("the number of blocks of nodes", 0, many);
    static_cast<void>(in_.count("the number of nodes", 0, many));
    if (!is_40_) skip_range();
    for (std::int64_t b = 0; b < blocks; ++b) {
      const auto first = in_.integer("an entity", -any, any);
      const auto second = in_.integer("an entity", -any, any);
      const auto dimension = is_40_ ? second : first;
      const bool parametric = in_.integer("the mark of parametric nodes", 0, 1) == 1;
      const std::int64_t parameters = parametric ? std::clamp<std::int64_t>(dimension, 0, 3) : 0;
      const auto count = in_.count("a number of nodes", 0, many);
      is_40_ ? read_block_40(count, parametric) : read_block(count, parameters);
    }
  }

  void skip_range() {
    static_cast<void>(in_.count("the least number", 0, many));
    static_cast<void>(in_.count("the largest number", 0, many));
  }

  /// Reads a block of nodes: all numbers, then all positions.
  void read_block(std::int64_t count, std::int64_t parameters) {
    const std::size_t first = mesh_.nodes.size();
    for (std::int64_t i = 0; i < count; ++i)
      mesh_.nodes.push_back({in_.count("the number of a node", 1, many), in_.line(), Eigen::Vector3d::Zero()});
    for (std::int64_t i = 0; i < count; ++i) {
      mesh_.nodes[first + static_cast<std::size_t>(i)].x = position();
      for (std::int64_t k = 0; k < parameters; ++k) static_cast<void>(in_.real("a parameter of a node"));
    }
  }

  void read_block_40(std::int64_t count, bool parametric) {
    for (std::int64_t i = 0; i < count; ++i) {
      const auto label = in_.count("the number of a node", 1, many);
      const auto line = in_.line();
      mesh_.nodes.push_back({label, line, position()});
      if (parametric) in_.text().skip_line();
    }
  }

  const GmshElement& element_of_type(std::int64_t type) {
    const GmshElement& element = gmsh_element(type);
    if (element.nodes == 0)
      in_.fail("elements of type " + std::to_string(type) +
               " are not read, only those of order 1 and 2: set Mesh.ElementOrder to 1 or 2");
    return element;
  }

  void read_elements_2() {
    const auto count = in_.text().whole_number("the number of elements", 0, any);
    in_.text().skip_line();
    for (std::int64_t read = 0; read < count;) {
      if (!in_.is_binary()) {
        const auto label = in_.integer("the number of an element", 1, any);
        const auto type = in_.integer("the type of an element", 1, any);
        const auto tags = in_.integer("a number of tags", 0, any);
        read_element_2(label, element_of_type(type), tags);
        ++read;
        continue;
      }
      const auto type = in_.integer("the type of elements", 1, any);
      const auto block = in_.integer("a number of elements", 1, any);
      const auto tags = in_.integer("a number of tags", 0, any);
      const GmshElement& element = element_of_type(type);
      for (std::int64_t i = 0; i < block; ++i, ++read)
        read_element_2(in_.integer("the number of an element", 1, any), element, tags);
    }
  }

  /// Reads the elements of MSH 1, each with its physical group, 0 for none, its entity and its count of nodes.
  void read_elements_1() {
    const auto count = in_.text().whole_number("the number of elements", 0, any);
    for (std::int64_t i = 0; i < count; ++i) {
      const auto label = in_.integer("the number of an element", 1, any);
      const GmshElement& element = element_of_type(in_.integer("the type of an element", 1, any));
      const auto group = in_.integer("the physical group of an element", -any, any);
      static_cast<void>(in_.integer("the entity of an element", -any, any));
      require_nodes(element, in_.integer("a number of nodes", 0, any), true);
      read_element_nodes(label, element, group == 0 ? std::set<std::int64_t>{} : std::set{std::abs(group)}, false);
    }
  }

  /// Reads the elements of MSH 3, each with its entity and the count of what follows: nodes, and perhaps its parent and
  /// parts of a partition.
  void read_elements_3() {
    const auto count = in_.text().whole_number("the number of elements", 0, any);
    in_.text().skip_line();
    for (std::int64_t i = 0; i < count; ++i) {
      const auto label = in_.integer("the number of an element", 1, any);
      const GmshElement& element = element_of_type(in_.integer("the type of an element", 1, any));
      const auto entity = in_.integer("the entity of an element", -any, any);
      const auto data = in_.integer("a number of nodes", 0, any);
      require_nodes(element, data, false);
      const auto groups = groups_of_entity_.find({element.dimension, entity});
      read_element_nodes(label, element, groups == groups_of_entity_.end() ? std::set<std::int64_t>{} : groups->second,
                         false);
      for (auto k = static_cast<std::int64_t>(element.nodes); k < data; ++k)
        static_cast<void>(in_.integer("what follows the nodes of an element", -any, any));
    }
  }

  void require_nodes(const GmshElement& element, std::int64_t found, bool exactly) const {
    const auto wanted = static_cast<std::int64_t>(element.nodes);
    if (found == wanted || (!exactly && found > wanted)) return;
    in_.fail("an element of " + std::to_string(wanted) + " nodes has " + std::to_string(found));
  }

  /// Reads an element of MSH 2, whose first tag is the physical group, 0 for none.
  void read_element_2(std::int64_t label, const GmshElement& element, std::int64_t tags) {
    std::set<std::int64_t> groups;
    for (std::int64_t t = 0; t < tags; ++t) {
      const auto tag = in_.integer("a tag of an element", -any, any);
      if (t == 0 && tag != 0) groups.insert(tag < 0 ? -tag : tag);
    }
    read_element_nodes(label, element, groups, false);
  }

  void read_elements_4() {
    in_.text().skip_line();
    const auto blocks = in_.count("the number of blocks of elements", 0, many);
    static_cast<void>(in_.count("the number of elements", 0, many));
    if (!is_40_) skip_range();
    for (std::int64_t b = 0; b < blocks; ++b) {
      const auto first = in_.integer("an entity", -any, any);
      const auto second = in_.integer("an entity", -any, any);
      const Group entity = is_40_ ? Group{second, first} : Group{first, second};
      const GmshElement& element = element_of_type(in_.integer("the type of elements", 1, any));
      const auto groups = groups_of_entity_.find(entity);
      const auto count = in_.count("a number of elements", 0, many);
      for (std::int64_t i = 0; i < count; ++i)
        read_element_nodes(in_.count("the number of an element", 1, many), element,
                           groups == groups_of_entity_.end() ? std::set<std::int64_t>{} : groups->second, true);
    }
  }

  void read_element_nodes(std::int64_t label, const GmshElement& element, const std::set<std::int64_t>& groups,
                          bool wide) {
    const auto line = in_.line();
    std::array<std::int64_t, 27> nodes{};
    for (std::size_t a = 0; a < element.nodes; ++a)
      nodes[a] = wide ? in_.count("a node of an element", 1, many) : in_.integer("a node of an element", 1, any);
    for (const std::int64_t group : groups) {
      mesh::LabelledSet& set = sets_[{element.dimension, group}];
      if (element.dimension == 3) set.labels.push_back(label);
      if (element.dimension < 3)
        set.labels.insert(set.labels.end(), nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(element.nodes));
    }
    if (element.dimension < 3) return;
    mesh_.cells.push_back({label, line, element.shape, mesh_.cell_nodes.size(), element.nodes});
    for (const std::size_t place : element.order) mesh_.cell_nodes.push_back(nodes[place]);
  }

  void add_sets() {
    constexpr std::array<const char*, 4> kinds{"point_", "curve_", "surface_", "volume_"};
    for (auto& [group, set] : sets_) {
      const auto named = names_.find(group);
      set.name = named != names_.end() ? named->second
                                       : kinds[static_cast<std::size_t>(group.first)] + std::to_string(group.second);
      (group.first == 3 ? mesh_.cell_sets : mesh_.node_sets).push_back(std::move(set));
    }
  }

  GmshNumbers in_;
  double metres_per_unit_;
  bool is_2_ = false;  ///< or MSH 1, which differs by its sections
  bool is_3_ = false;
  bool is_40_ = false;
  mesh::LabelledMesh mesh_;
  std::map<Group, std::string> names_;
  std::map<Group, std::set<std::int64_t>> groups_of_entity_;
  std::map<Group, mesh::LabelledSet> sets_;
};

}  // namespace

mesh::LabelledMesh gmsh_mesh(std::string_view bytes, const std::string& name, double metres_per_unit) {
  require_metres_per_unit(metres_per_unit, name);
  return GmshReader(bytes, name, metres_per_unit).read();
}

mesh::SolidMesh read_gmsh(const std::filesystem::path& path, double metres_per_unit) {
  return mesh::solid_mesh(gmsh_mesh(core::read_file(path), path.string(), metres_per_unit));
}

}  // namespace thinwall::io

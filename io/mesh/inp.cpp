#include "io/mesh/inp.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "core/atomic_file.hpp"
#include "io/mesh/inp_text.hpp"
#include "io/surface_unit.hpp"
#include "mesh/solid/labelled_checks.hpp"

namespace thinwall::io {

namespace {

using Labels = std::vector<std::int64_t>;
using TextSets = std::map<std::string, InpTextSet>;

// Costs of steps relative to the visit of one label, by their time.
constexpr std::size_t set_cost = 25, range_cost = 5, member_cost = 5;

/// Expands ranges into labels and limits the work, because a text of a few bytes may refer to every node or every set.
class Expansion {
 public:
  explicit Expansion(const InpText& text) : text_(text) {
    for (const mesh::LabelledNode& node : text.mesh.nodes) node_labels_.push_back(node.label);
    for (std::size_t c = 0; c < text.mesh.cells.size(); ++c) cells_[text.mesh.cells[c].label] = c;
    for (const auto& [label, cell] : cells_) cell_labels_.push_back(label);
    for (const InpTextFlat& element : text.flat) flat_[element.label] = &element;
    for (const auto& [label, element] : flat_) flat_labels_.push_back(label);
    left_ = 120000000 + 1200 * (node_labels_.size() + cell_labels_.size());
  }

  /// The ranges of a set and of those that are part of it, directly or through others.
  std::vector<InpLabelRange> all_ranges(const TextSets& sets, const std::string& name) {
    std::vector<InpLabelRange> ranges;
    std::vector<const InpTextSet*> open{&sets.at(name)};
    std::set<const InpTextSet*> seen{open.back()};
    while (!open.empty()) {
      const InpTextSet& set = *open.back();
      open.pop_back();
      charge(set_cost * (1 + set.others.size()) + set.ranges.size(), 0);
      ranges.insert(ranges.end(), set.ranges.begin(), set.ranges.end());
      for (const std::string& other : set.others)
        if (const InpTextSet* part = &sets.at(other); seen.insert(part).second) open.push_back(part);
    }
    return ranges;
  }

  Labels nodes(const std::vector<InpLabelRange>& ranges) { return expanded(ranges, node_labels_); }

  /// The set of nodes of the ranges; one that names a node which is not there has a fault.
  mesh::LabelledSet node_set(const std::string& name, const std::vector<InpLabelRange>& ranges) {
    mesh::LabelledSet set{name, nodes(ranges)};
    const auto missing = std::find_if(ranges.begin(), ranges.end(), [this](const InpLabelRange& range) {
      return !range.gaps_allowed && !std::binary_search(node_labels_.begin(), node_labels_.end(), range.first);
    });
    if (missing == ranges.end()) return set;
    set.fault = mesh::place_of(text_.mesh, missing->line) + ": the set \"" + name + "\" names node " +
                std::to_string(missing->first) + ", which is not among the nodes of the file";
    return set;
  }

  /// The cells of the ranges; elements that are no solids are left out.
  Labels cells(const std::vector<InpLabelRange>& ranges) { return expanded(ranges, cell_labels_); }

  /// The nodes of the elements that are no solids.
  Labels nodes_of_flat(const std::vector<InpLabelRange>& ranges) {
    Labels nodes;
    for (const std::int64_t label : expanded(ranges, flat_labels_)) {
      const InpTextFlat& element = *flat_.at(label);
      for (std::size_t a = element.first; a < element.first + element.nodes; ++a) {
        const std::int64_t node = text_.flat_nodes[a];
        if (std::binary_search(node_labels_.begin(), node_labels_.end(), node)) add(node, 0, nodes);
      }
    }
    return nodes;
  }

  /// The nodes of the faces of a surface, as a set.
  mesh::LabelledSet surface(const std::string& name, const std::vector<InpTextFace>& faces) {
    mesh::LabelledSet set{name, {}};
    for (const InpTextFace& face : faces) {
      const std::vector<InpLabelRange> ranges = members(face);
      if (face.face > 0) {
        for (const std::int64_t label : cells(ranges)) add_face(face, text_.mesh.cells[cells_.at(label)], set.labels);
        continue;
      }
      const bool of_nodes = face.face == 0;
      mesh::LabelledSet part = of_nodes ? node_set(name, ranges) : mesh::LabelledSet{name, nodes_of_flat(ranges)};
      if (!of_nodes && part.labels.empty()) require_no_solid(face, ranges);
      set.labels.insert(set.labels.end(), part.labels.begin(), part.labels.end());
      if (set.fault.empty()) set.fault = std::move(part.fault);
    }
    return set;
  }

 private:
  Labels expanded(const std::vector<InpLabelRange>& ranges, const Labels& known) {
    Labels labels;
    if (known.empty()) return labels;
    for (const InpLabelRange& range : ranges) add_range(range, known, labels);
    std::sort(labels.begin(), labels.end());
    labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
    return labels;
  }

  /// Adds the labels of a range, by going through the labels that exist, or through the range if that is much shorter.
  void add_range(const InpLabelRange& range, const Labels& known, Labels& labels) {
    const auto begin = std::lower_bound(known.begin(), known.end(), range.first);
    const auto end = std::upper_bound(begin, known.end(), range.last);
    const std::int64_t steps = (range.last - range.first) / range.step + 1;
    charge(range_cost, range.line);
    if (steps < (end - begin) / 16) {
      charge(2 * range_cost * static_cast<std::size_t>(steps), range.line);
      for (std::int64_t label = range.first; label <= range.last; label += range.step)
        if (std::binary_search(begin, end, label)) add(label, range.line, labels);
      return;
    }
    charge(static_cast<std::size_t>(end - begin), range.line);
    for (auto label = begin; label != end; ++label)
      if ((*label - range.first) % range.step == 0) add(*label, range.line, labels);
  }

  void charge(std::size_t cost, int line) {
    if (cost > left_)
      mesh::fail_at(text_.mesh, line,
                    "the sets of the file have too many members, or too many sets in each other; drop some of them");
    left_ -= cost;
  }

  void add(std::int64_t label, int line, Labels& labels) {
    charge(member_cost, line);
    labels.push_back(label);
  }

  /// Throws DataError if SPOS or SNEG, the sides of a shell, is said of a solid.
  void require_no_solid(const InpTextFace& face, const std::vector<InpLabelRange>& ranges) {
    const Labels solids = cells(ranges);
    if (!solids.empty())
      mesh::fail_at(text_.mesh, face.line,
                    "element " + std::to_string(solids.front()) + " is a solid, which has no face SPOS or SNEG");
  }

  std::vector<InpLabelRange> members(const InpTextFace& face) {
    const bool of_nodes = face.face == 0;
    const TextSets& sets = of_nodes ? text_.node_sets : text_.element_sets;
    if (!face.set.empty() && !sets.contains(face.set))
      mesh::fail_at(text_.mesh, face.line, "the set \"" + face.set + "\" of a surface is not in the file");
    if (face.set.empty()) return {{face.label, face.label, 1, face.line, false}};
    return all_ranges(sets, face.set);
  }

  /// Adds the corners of a face and the nodes of the edges between them.
  void add_face(const InpTextFace& face, const mesh::LabelledCell& cell, Labels& nodes) {
    // The place in mesh::topology() of each face, by shape and by the format's number.
    constexpr std::array<std::array<std::size_t, 6>, 4> places{
        {{3, 2, 0, 1, 9, 9}, {0, 1, 2, 3, 4, 5}, {0, 1, 2, 3, 4, 9}, {0, 1, 2, 3, 4, 9}}};
    const mesh::CellTopology& shape = mesh::topology(cell.shape);
    const std::size_t place = places[static_cast<std::size_t>(cell.shape)][static_cast<std::size_t>(face.face - 1)];
    if (place >= shape.faces.size())
      mesh::fail_at(text_.mesh, face.line,
                    "element " + std::to_string(cell.label) + " has no face S" + std::to_string(face.face));
    const auto& corners = shape.faces[place];
    const auto is_in = [&corners](std::size_t c) {
      return std::find(corners.begin(), corners.end(), c) != corners.end();
    };
    for (const std::size_t corner : corners) add(text_.mesh.cell_nodes[cell.first + corner], face.line, nodes);
    if (mesh::cell_order(cell.shape, cell.nodes) != 2) return;
    for (std::size_t e = 0; e < shape.edges.size(); ++e)
      if (is_in(shape.edges[e][0]) && is_in(shape.edges[e][1]))
        add(text_.mesh.cell_nodes[cell.first + shape.corners + e], face.line, nodes);
  }

  const InpText& text_;
  Labels node_labels_;
  Labels cell_labels_;
  Labels flat_labels_;
  std::map<std::int64_t, std::size_t> cells_;
  std::map<std::int64_t, const InpTextFlat*> flat_;
  std::size_t left_ = 0;
};

void note_faults(const std::vector<mesh::LabelledSet>& sets, std::vector<std::string>& notices) {
  const auto has_fault = [](const mesh::LabelledSet& set) { return !set.fault.empty(); };
  const auto count = std::count_if(sets.begin(), sets.end(), has_fault);
  if (count == 0) return;
  notices.push_back(std::to_string(count) + " sets name missing nodes and cannot be used, the first at " +
                    std::find_if(sets.begin(), sets.end(), has_fault)->fault);
}

void expand_sets(InpText& text) {
  Expansion expansion(text);
  std::vector<mesh::LabelledSet> node_sets;
  std::vector<mesh::LabelledSet> cell_sets;
  for (const auto& [name, set] : text.node_sets)
    node_sets.push_back(expansion.node_set(name, expansion.all_ranges(text.node_sets, name)));
  for (const auto& [name, set] : text.element_sets) {
    const auto ranges = expansion.all_ranges(text.element_sets, name);
    Labels cells = expansion.cells(ranges);
    Labels nodes = expansion.nodes_of_flat(ranges);
    if (!cells.empty() || nodes.empty()) cell_sets.push_back({name, std::move(cells)});
    if (!nodes.empty() && !text.node_sets.contains(name)) node_sets.push_back({name, std::move(nodes)});
  }
  for (const auto& [name, faces] : text.surfaces)
    node_sets.push_back(expansion.surface(text.node_sets.contains(name) ? name + "_SURFACE" : name, faces));
  note_faults(node_sets, text.mesh.notices);
  text.mesh.node_sets = std::move(node_sets);
  text.mesh.cell_sets = std::move(cell_sets);
}

std::vector<InpMaterial> section_materials(const InpText& text) {
  std::vector<InpMaterial> result;
  std::map<std::string, const InpTextMaterial*> by_name;
  for (const InpTextMaterial& material : text.materials) by_name.emplace(material.name, &material);
  for (const InpTextSection& section : text.sections) {
    const auto found = by_name.find(section.material);
    if (found == by_name.end())
      mesh::fail_at(text.mesh, section.line, "the material \"" + section.material + "\" is not in the file");
    const InpTextMaterial& material = *found->second;
    result.push_back(
        {section.element_set, material.name, material.youngs_modulus, material.poisson_ratio, material.density});
  }
  return result;
}

}  // namespace

InpLabelled inp_mesh(std::string_view bytes, const std::string& name, double metres_per_unit,
                     const InpInclude& include) {
  require_metres_per_unit(metres_per_unit, name);
  InpText text = inp_text(bytes, name, metres_per_unit, include);
  if (text.mesh.cells.empty()) mesh::fail_at(text.mesh, 0, "holds no *ELEMENT of a solid, such as TYPE=C3D10");
  mesh::sort_nodes(text.mesh);
  expand_sets(text);
  std::vector<InpMaterial> materials = section_materials(text);
  return {std::move(text.mesh), std::move(materials), std::move(text.included)};
}

InpPart read_inp_part(const std::filesystem::path& path, double metres_per_unit) {
  InpLabelled labelled = inp_mesh(core::read_file(path), path.string(), metres_per_unit);
  return {mesh::solid_mesh(std::move(labelled.mesh)), std::move(labelled.materials)};
}

mesh::SolidMesh read_inp(const std::filesystem::path& path, double metres_per_unit) {
  return read_inp_part(path, metres_per_unit).solid;
}

std::string what_lacks(const InpMaterial& material) {
  std::string text;
  const auto add = [&text](const std::optional<double>& value, const char* name) {
    if (!value) text += (text.empty() ? "" : ", ") + std::string(name);
  };
  add(material.youngs_modulus, "Young's modulus");
  add(material.poisson_ratio, "Poisson's ratio");
  add(material.density, "density");
  return text;
}

InpMaterial in_si(InpMaterial material, double metres_per_unit, double kg_per_mass_unit) {
  if (material.youngs_modulus) *material.youngs_modulus *= kg_per_mass_unit / metres_per_unit;
  if (material.density) *material.density *= kg_per_mass_unit / (metres_per_unit * metres_per_unit * metres_per_unit);
  return material;
}

}  // namespace thinwall::io

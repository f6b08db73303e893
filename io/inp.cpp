#include "io/inp.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/nearest_name.hpp"
#include "io/inp_text.hpp"

namespace thinwall::io {

namespace {

/// The edge within which each of nodes 5 to 10 of a C3D10 lies (CalculiX manual, "Ten-node tetrahedral element").
constexpr std::array<std::array<std::size_t, 2>, 6> edges{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

/// For each node of the file's element the index of the same node in mesh::lattice(order).
std::vector<Eigen::Index> lattice_index(int order) {
  std::vector<Eigen::Index> index{0, 1, 2, 3};
  if (order == 1) return index;
  const auto lattice = mesh::lattice(2);
  for (const auto& [a, b] : edges) {
    std::array<int, 4> alpha{};
    alpha[a] = alpha[b] = 1;
    index.push_back(std::find(lattice.begin(), lattice.end(), alpha) - lattice.begin());
  }
  return index;
}

/// Sorted by label; a label twice is an error.
void sort_nodes(InpText& text) {
  const auto by_label = [](const InpTextNode& a, const InpTextNode& b) { return a.label < b.label; };
  if (!std::is_sorted(text.nodes.begin(), text.nodes.end(), by_label)) {
    std::stable_sort(text.nodes.begin(), text.nodes.end(), by_label);
  }
  const auto same = [](const InpTextNode& a, const InpTextNode& b) { return a.label == b.label; };
  const auto twice = std::adjacent_find(text.nodes.begin(), text.nodes.end(), same);
  if (twice == text.nodes.end()) return;
  const int line = std::max(twice->line, (twice + 1)->line);
  fail_at(text, line,
          "node " + std::to_string(twice->label) + " is there already, in line " +
              std::to_string(std::min(twice->line, (twice + 1)->line)) + ": give every node a number of its own");
}

/// The first of the sorted nodes whose label is not below this one.
std::size_t lower_bound(const InpText& text, int label) {
  const auto at_or_after = [](const InpTextNode& node, int value) { return node.label < value; };
  return static_cast<std::size_t>(std::lower_bound(text.nodes.begin(), text.nodes.end(), label, at_or_after) -
                                  text.nodes.begin());
}

/// The row of a node; most files number without gaps, so that its place can be told without a search.
int row_of(const InpText& text, int label, int line) {
  auto row = text.nodes.size();
  if (!text.nodes.empty() && label >= text.nodes.front().label) {
    row = static_cast<std::size_t>(label - text.nodes.front().label);
    if (row >= text.nodes.size() || text.nodes[row].label != label) row = lower_bound(text, label);
  }
  if (row >= text.nodes.size() || text.nodes[row].label != label) {
    fail_at(text, line, "node " + std::to_string(label) + " is in no *NODE");
  }
  return static_cast<int>(row);
}

void require_elements_once(const InpText& text) {
  std::vector<std::pair<int, int>> labels;
  for (const InpTextElement& element : text.elements) labels.emplace_back(element.label, element.line);
  std::sort(labels.begin(), labels.end());
  for (std::size_t i = 1; i < labels.size(); ++i) {
    if (labels[i].first != labels[i - 1].first) continue;
    fail_at(text, labels[i].second,
            "element " + std::to_string(labels[i].first) + " is there already, in line " +
                std::to_string(labels[i - 1].second) + ": give every element a number of its own");
  }
}

enum class Role : char { unused, corner, midside };

/// What each node is to the elements.
std::vector<Role> roles(const InpText& text) {
  std::vector<Role> role(text.nodes.size(), Role::unused);
  const std::size_t count = inp_node_count(text.order);
  for (const InpTextElement& element : text.elements) {
    for (std::size_t a = 0; a < count; ++a) {
      Role& known = role[static_cast<std::size_t>(element.nodes[a])];
      const Role here = a < 4 ? Role::corner : Role::midside;
      if (known != Role::unused && known != here) {
        const int label = text.nodes[static_cast<std::size_t>(element.nodes[a])].label;
        fail_at(text, element.line,
                "node " + std::to_string(label) + " is a corner of one element and within an edge of another: the " +
                    "elements do not fit together");
      }
      known = here;
    }
  }
  return role;
}

/// The final index of each of the text's nodes, −1 for those left out: corners first, each kind by rising label.
std::vector<int> place_nodes(const InpText& text, InpMesh& inp) {
  const std::vector<Role> role = roles(text);
  std::vector<int> place(text.nodes.size(), -1);
  for (const Role kind : {Role::corner, Role::midside}) {
    for (std::size_t row = 0; row < place.size(); ++row) {
      if (role[row] != kind) continue;
      place[row] = static_cast<int>(inp.node_labels.size());
      inp.node_labels.push_back(text.nodes[row].label);
      if (kind == Role::corner) inp.mesh.vertices.push_back(text.nodes[row].x);
    }
  }
  inp.nodes.order = text.order;
  inp.nodes.positions.resize(static_cast<Eigen::Index>(inp.node_labels.size()), 3);
  for (std::size_t row = 0; row < place.size(); ++row) {
    if (place[row] >= 0) inp.nodes.positions.row(place[row]) = text.nodes[row].x.transpose();
  }
  return place;
}

void place_elements(const InpText& text, const std::vector<int>& place, InpMesh& inp) {
  const auto index = lattice_index(text.order);
  inp.nodes.elements.resize(static_cast<Eigen::Index>(text.elements.size()), static_cast<Eigen::Index>(index.size()));
  for (const InpTextElement& element : text.elements) {
    const auto tet = static_cast<Eigen::Index>(inp.mesh.tets.size());
    for (std::size_t a = 0; a < index.size(); ++a) {
      inp.nodes.elements(tet, index[a]) = place[static_cast<std::size_t>(element.nodes[a])];
    }
    inp.element_labels.push_back(element.label);
    auto& corners = inp.mesh.tets.emplace_back();
    for (std::size_t k = 0; k < 4; ++k) corners[k] = inp.nodes.elements(tet, static_cast<Eigen::Index>(k));
    if (!(mesh::volume(inp.mesh, static_cast<int>(tet)) > 0.0)) {
      fail_at(text, element.line,
              "element " + std::to_string(element.label) +
                  " has no positive volume: its corners lie in one plane, or the first three run clockwise seen from "
                  "the fourth");
    }
  }
}

double midside_offset(const InpMesh& inp) {
  double worst = 0.0;
  if (inp.nodes.order == 1) return worst;
  const auto index = lattice_index(2);
  for (Eigen::Index tet = 0; tet < inp.nodes.elements.rows(); ++tet) {
    const auto position = [&](Eigen::Index local) { return inp.nodes.positions.row(inp.nodes.elements(tet, local)); };
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const Eigen::RowVector3d a = position(static_cast<Eigen::Index>(edges[e][0]));
      const Eigen::RowVector3d b = position(static_cast<Eigen::Index>(edges[e][1]));
      worst = std::max(worst, (position(index[4 + e]) - 0.5 * (a + b)).squaredNorm() / (b - a).squaredNorm());
    }
  }
  return std::sqrt(worst);
}

void place_sets(const InpText& text, const std::vector<int>& place, InpMesh& inp) {
  for (const auto& [name, ranges] : text.sets) {
    NodeSet set{name, {}};
    const auto add = [&](std::size_t row) {
      if (place[row] >= 0) set.nodes.push_back(place[row]);
    };
    for (const InpLabelRange& range : ranges) {
      if (!range.gaps_allowed) {
        add(static_cast<std::size_t>(row_of(text, range.first, range.line)));
        continue;
      }
      for (auto row = lower_bound(text, range.first); row < text.nodes.size(); ++row) {
        if (text.nodes[row].label > range.last) break;
        if ((text.nodes[row].label - range.first) % range.step == 0) add(row);
      }
    }
    std::sort(set.nodes.begin(), set.nodes.end());
    set.nodes.erase(std::unique(set.nodes.begin(), set.nodes.end()), set.nodes.end());
    inp.sets.push_back(std::move(set));
  }
}

/// A coordinate in at most twenty characters, which is as wide as the format's fields are.
void append_number(std::string& text, double value) {
  std::array<char, 40> digits{};
  char* const begin = digits.data();
  char* end = std::to_chars(begin, begin + digits.size(), value).ptr;
  for (int precision = 16; end - begin > 20; --precision) {
    end = std::to_chars(begin, begin + digits.size(), value, std::chars_format::scientific, precision).ptr;
  }
  text.append(begin, end);
}

void append_label(std::string& text, int label) {
  std::array<char, 12> digits{};
  text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), label).ptr);
}

void append_nodes(std::string& text, const mesh::LagrangeNodes& nodes) {
  text += "*NODE, NSET=ALL_NODES\n";
  for (Eigen::Index i = 0; i < nodes.positions.rows(); ++i) {
    append_label(text, static_cast<int>(i) + 1);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(nodes.positions(i, axis))) {
        throw core::NumericalError("node " + std::to_string(i + 1) + " has a coordinate that is not finite");
      }
      text += ", ";
      append_number(text, nodes.positions(i, axis));
    }
    text += '\n';
  }
}

void append_elements(std::string& text, const mesh::LagrangeNodes& nodes) {
  text += nodes.order == 1 ? "*ELEMENT, TYPE=C3D4, ELSET=ALL\n" : "*ELEMENT, TYPE=C3D10, ELSET=ALL\n";
  const auto index = lattice_index(nodes.order);
  for (Eigen::Index tet = 0; tet < nodes.elements.rows(); ++tet) {
    append_label(text, static_cast<int>(tet) + 1);
    for (const Eigen::Index local : index) {
      text += ", ";
      append_label(text, nodes.elements(tet, local) + 1);
    }
    text += '\n';
  }
}

void append_set(std::string& text, const NodeSet& set) {
  const bool sound = !set.name.empty() && set.name.size() <= 80 &&
                     set.name.find_first_of(",*=\"\n\r\t ") == std::string::npos &&
                     (set.name.front() < '0' || set.name.front() > '9');
  if (!sound) {
    throw core::InputError("\"" + set.name +
                           "\" cannot name a node set: use 1 to 80 letters, digits and '_', a letter first");
  }
  text += "*NSET, NSET=" + set.name + '\n';
  for (std::size_t i = 0; i < set.nodes.size(); ++i) {
    append_label(text, set.nodes[i] + 1);
    text += (i % 16 == 15 || i + 1 == set.nodes.size()) ? "\n" : ", ";
  }
}

void append_step(std::string& text, const InpFrequencyStep& step, const std::vector<NodeSet>& sets) {
  text += "*MATERIAL, NAME=PART\n*ELASTIC\n";
  append_number(text, step.youngs_modulus_Pa);
  text += ", ";
  append_number(text, step.poisson_ratio);
  text += "\n*DENSITY\n";
  append_number(text, step.density_kg_m3);
  text += "\n*SOLID SECTION, ELSET=ALL, MATERIAL=PART\n";
  if (!step.fixed.empty()) text += "*BOUNDARY\n";
  for (const std::string& name : step.fixed) {
    const auto is_it = [&](const NodeSet& set) { return set.name == name; };
    if (std::none_of(sets.begin(), sets.end(), is_it)) {
      throw core::InputError("the fixed node set \"" + name + "\" is none of those that are written");
    }
    text += name + ", 1, 3\n";
  }
  text += "*STEP\n*FREQUENCY\n" + std::to_string(step.modes) + "\n*END STEP\n";
}

}  // namespace

InpMesh read_inp(const std::filesystem::path& path, double metres_per_unit) {
  if (!(metres_per_unit > 0.0) || !std::isfinite(metres_per_unit)) {
    throw core::InputError("the unit of \"" + path.string() + "\" is " + std::to_string(metres_per_unit) +
                           " m; it must be positive and finite");
  }
  InpText text = read_inp_text(path, metres_per_unit);
  if (text.elements.empty()) throw core::DataError(path.string() + ": holds no *ELEMENT of TYPE=C3D4 or C3D10");
  sort_nodes(text);
  require_elements_once(text);
  const std::size_t count = inp_node_count(text.order);
  for (InpTextElement& element : text.elements) {
    for (std::size_t a = 0; a < count; ++a) element.nodes[a] = row_of(text, element.nodes[a], element.line);
  }
  InpMesh inp;
  const std::vector<int> place = place_nodes(text, inp);
  place_elements(text, place, inp);
  place_sets(text, place, inp);
  inp.midside_offset = midside_offset(inp);
  return inp;
}

const NodeSet& node_set(const InpMesh& inp, const std::string& name, const std::filesystem::path& path) {
  const std::string wanted = capitals(name);
  std::vector<std::string> names;
  for (const NodeSet& set : inp.sets) {
    if (set.name == wanted) return set;
    names.push_back(set.name);
  }
  throw core::DataError(path.string() + ": holds no node set \"" + wanted + "\"" + core::did_you_mean(wanted, names));
}

void write_inp(const std::filesystem::path& path, const mesh::LagrangeNodes& nodes, const std::vector<NodeSet>& sets,
               const std::optional<InpFrequencyStep>& step) {
  if (nodes.order != 1 && nodes.order != 2) {
    throw core::InputError("an input file holds elements of order 1 or 2, not " + std::to_string(nodes.order));
  }
  std::string text = "** lengths in m, SI throughout\n";
  text.reserve(static_cast<std::size_t>(72 * nodes.positions.rows() + 96 * nodes.elements.rows()));
  append_nodes(text, nodes);
  append_elements(text, nodes);
  for (const NodeSet& set : sets) append_set(text, set);
  if (step) append_step(text, *step, sets);
  core::write_file_atomically(path, text);
}

}  // namespace thinwall::io

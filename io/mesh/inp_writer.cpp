#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/mesh/inp.hpp"
#include "mesh/solid/cell_shape.hpp"

namespace thinwall::io {

namespace {

/// The index in mesh::lattice(order) of each node of the file's element.
std::vector<Eigen::Index> lattice_index(int order) {
  std::vector<Eigen::Index> index{0, 1, 2, 3};
  if (order == 1) return index;
  const auto lattice = mesh::lattice(2);
  for (const auto& [a, b] : mesh::topology(mesh::CellShape::tetrahedron).edges) {
    std::array<int, 4> alpha{};
    alpha[a] = alpha[b] = 1;
    index.push_back(std::find(lattice.begin(), lattice.end(), alpha) - lattice.begin());
  }
  return index;
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

void append_set(std::string& text, const mesh::NodeSet& set) {
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

void append_step(std::string& text, const InpFrequencyStep& step, const std::vector<mesh::NodeSet>& sets) {
  text += "*MATERIAL, NAME=PART\n*ELASTIC\n";
  append_number(text, step.youngs_modulus_Pa);
  text += ", ";
  append_number(text, step.poisson_ratio);
  text += "\n*DENSITY\n";
  append_number(text, step.density_kg_m3);
  text += "\n*SOLID SECTION, ELSET=ALL, MATERIAL=PART\n";
  if (!step.fixed.empty()) text += "*BOUNDARY\n";
  for (const std::string& name : step.fixed) {
    const auto is_it = [&](const mesh::NodeSet& set) { return set.name == name; };
    if (std::none_of(sets.begin(), sets.end(), is_it)) {
      throw core::InputError("the fixed node set \"" + name + "\" is none of those that are written");
    }
    text += name + ", 1, 3\n";
  }
  text += "*STEP\n*FREQUENCY\n" + std::to_string(step.modes) + "\n*END STEP\n";
}

}  // namespace

void write_inp(const std::filesystem::path& path, const mesh::LagrangeNodes& nodes,
               const std::vector<mesh::NodeSet>& sets, const std::optional<InpFrequencyStep>& step) {
  if (nodes.order != 1 && nodes.order != 2) {
    throw core::InputError("an input file holds elements of order 1 or 2, not " + std::to_string(nodes.order));
  }
  std::string text = "** lengths in m, SI throughout\n";
  text.reserve(static_cast<std::size_t>(72 * nodes.positions.rows() + 96 * nodes.elements.rows()));
  append_nodes(text, nodes);
  append_elements(text, nodes);
  for (const mesh::NodeSet& set : sets) append_set(text, set);
  if (step) append_step(text, *step, sets);
  core::write_file_atomically(path, text);
}

}  // namespace thinwall::io

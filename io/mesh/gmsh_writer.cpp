#include <algorithm>
#include <array>
#include <cmath>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "io/mesh/gmsh.hpp"
#include "io/mesh/gmsh_element.hpp"

namespace thinwall::io {

namespace {

void append_name(std::string& text, int dimension, std::size_t tag, const std::string& name) {
  if (name.empty() || name.find_first_of("\"\r\n") != std::string::npos)
    throw core::InputError("\"" + name + "\" cannot name a physical group: use letters, digits and '_'");
  text += std::to_string(dimension) + " " + std::to_string(tag) + " \"" + name + "\"\n";
}

void append_node_section(std::string& text, const mesh::LagrangeNodes& nodes) {
  text += "$Nodes\n" + std::to_string(nodes.positions.rows()) + "\n";
  for (Eigen::Index i = 0; i < nodes.positions.rows(); ++i) {
    text += std::to_string(i + 1);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      if (!std::isfinite(nodes.positions(i, axis)))
        throw core::NumericalError("node " + std::to_string(i + 1) + " has a coordinate that is not finite");
      text += " " + core::number_text(nodes.positions(i, axis));
    }
    text += "\n";
  }
  text += "$EndNodes\n";
}

/// The column in LagrangeNodes::elements of each of Gmsh's nodes of a tetrahedron.
std::vector<Eigen::Index> gmsh_columns(int order) {
  const GmshElement& element = gmsh_element(order == 1 ? 4 : 11);
  const auto lattice = mesh::lattice(order);
  std::vector<Eigen::Index> columns(element.nodes);
  const auto& edges = mesh::topology(mesh::CellShape::tetrahedron).edges;
  for (std::size_t a = 0; a < element.nodes; ++a) {
    std::array<int, 4> alpha{};
    if (a < 4) alpha[a] = order;
    if (a >= 4) alpha[edges[a - 4][0]] = alpha[edges[a - 4][1]] = 1;
    columns[element.order[a]] =
        static_cast<Eigen::Index>(std::find(lattice.begin(), lattice.end(), alpha) - lattice.begin());
  }
  return columns;
}

}  // namespace

void write_gmsh(const std::filesystem::path& path, const mesh::SolidMesh& solid) {
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" +
                     std::to_string(solid.node_sets.size() + solid.element_sets.size()) + "\n";
  for (std::size_t s = 0; s < solid.node_sets.size(); ++s) append_name(text, 0, s + 1, solid.node_sets[s].name);
  for (std::size_t s = 0; s < solid.element_sets.size(); ++s) append_name(text, 3, s + 1, solid.element_sets[s].name);
  text += "$EndPhysicalNames\n";
  append_node_section(text, solid.nodes);

  std::string elements;
  std::size_t count = 0;
  const auto columns = gmsh_columns(solid.nodes.order);
  const auto add_tet = [&](int tet, std::size_t tag) {
    elements += std::to_string(++count) + (solid.nodes.order == 1 ? " 4 2 " : " 11 2 ") + std::to_string(tag) + " 1";
    for (const Eigen::Index column : columns) elements += " " + std::to_string(solid.nodes.elements(tet, column) + 1);
    elements += "\n";
  };
  std::vector<bool> has_set(solid.mesh.tets.size(), false);
  for (const mesh::ElementSet& set : solid.element_sets)
    for (const int tet : set.tets) has_set[static_cast<std::size_t>(tet)] = true;
  for (std::size_t tet = 0; tet < has_set.size(); ++tet)
    if (!has_set[tet]) add_tet(static_cast<int>(tet), 0);
  for (std::size_t s = 0; s < solid.element_sets.size(); ++s)
    for (const int tet : solid.element_sets[s].tets) add_tet(tet, s + 1);
  for (std::size_t s = 0; s < solid.node_sets.size(); ++s)
    for (const int node : solid.node_sets[s].nodes)
      elements += std::to_string(++count) + " 15 2 " + std::to_string(s + 1) + " 1 " + std::to_string(node + 1) + "\n";
  text += "$Elements\n" + std::to_string(count) + "\n" + elements + "$EndElements\n";
  core::write_file_atomically(path, text);
}

}  // namespace thinwall::io

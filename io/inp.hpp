#pragma once
// Tetrahedral meshes in the input format of Abaqus and CalculiX: nodes, C3D4 and C3D10 elements, node sets.
//
// Layout: Dhondt, CalculiX CrunchiX User's Manual 2.20, "Element types" and "Input deck format". Fields are
// separated by commas, "**" starts a comment, keywords and names do not depend on case.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mesh/lagrange_nodes.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::io {

/// Some nodes under a name: ascending indices into the rows of LagrangeNodes::positions.
struct NodeSet {
  std::string name;
  std::vector<int> nodes;
};

/// What thinwall takes from an input file. Nodes that no element uses are left out, of the sets as well.
struct InpMesh {
  mesh::TetMesh mesh;               ///< the corners only, by ascending number in the file
  mesh::LagrangeNodes nodes;        ///< of order 1 (C3D4) or 2 (C3D10): the corners, then the nodes within the edges
  std::vector<int> node_labels;     ///< for each node its number in the file
  std::vector<int> element_labels;  ///< for each tetrahedron its number in the file
  std::vector<NodeSet> sets;        ///< by name, in capitals
  /// Largest distance of a C3D10's mid-edge node from the middle of its edge, over the length of the edge: elements
  /// are straight-sided where it is round-off.
  double midside_offset = 0.0;
};

/// Reads *NODE, *ELEMENT of TYPE=C3D4 or C3D10, and *NSET (also GENERATE, and sets by name), with NSET= of *NODE; other
/// keywords are passed over with their lines. A file does not tell its unit: `metres_per_unit` does.
/// Throws DataError with file and line: a keyword that makes or moves nodes or elements and is not read (*INCLUDE,
/// *SYSTEM, *NGEN ...), another type of element, both types in one file, text where a number belongs, a value that is
/// not finite, a node or element that is there twice or is missing, an element without positive volume; no elements.
/// Nodes that a range of GENERATE passes over may be absent. Cost O(bytes).
[[nodiscard]] InpMesh read_inp(const std::filesystem::path& path, double metres_per_unit);

/// The set of that name, whatever its case; throws DataError that offers the nearest name. `path` is for the message.
[[nodiscard]] const NodeSet& node_set(const InpMesh& inp, const std::string& name, const std::filesystem::path& path);

/// A homogeneous part whose natural modes are wanted.
struct InpFrequencyStep {
  double youngs_modulus_Pa = 0.0;
  double poisson_ratio = 0.0;
  double density_kg_m3 = 0.0;
  std::vector<std::string> fixed;  ///< sets whose nodes cannot move
  int modes = 10;
};

/// Writes nodes and elements of order 1 or 2 in SI, numbered from 1 in their order, the sets, and for CalculiX a
/// material and a *FREQUENCY step. Its fields are twenty characters wide, so that coordinates are written with at least
/// 14 significant digits (relative 5e-14). Written in one step. Throws InputError for another order, a set with an
/// empty name or one that the format cannot hold, or an unknown set in `fixed`; NumericalError for a coordinate that is
/// not finite; DataError if the file cannot be written.
void write_inp(const std::filesystem::path& path, const mesh::LagrangeNodes& nodes, const std::vector<NodeSet>& sets,
               const std::optional<InpFrequencyStep>& step = {});

}  // namespace thinwall::io

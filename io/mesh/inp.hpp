#pragma once
// Meshes in the input format of Abaqus and CalculiX: nodes, solid elements, sets, surfaces, materials.
//
// Layout: Dhondt, CalculiX CrunchiX User's Manual 2.20, "Element types" and "Input deck format". Fields are
// separated by commas, "**" starts a comment, keywords and names do not depend on case.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh/inp_lines.hpp"
#include "mesh/lagrange_nodes.hpp"
#include "mesh/solid/solid_mesh.hpp"

namespace thinwall::io {

/// The material that a *SOLID SECTION gives to a set of elements, in the file's own units; a value is absent if the
/// file does not contain it or the material is not isotropic.
struct InpMaterial {
  std::string element_set;
  std::string name;
  std::optional<double> youngs_modulus;  ///< mass / (length time²)
  std::optional<double> poisson_ratio;
  std::optional<double> density;  ///< mass / length³
};

/// A mesh and its materials.
struct InpPart {
  mesh::SolidMesh solid;
  std::vector<InpMaterial> materials;  ///< one for each section
};

/// The nodes and elements of a file under its own numbers, and its materials.
struct InpLabelled {
  mesh::LabelledMesh mesh;
  std::vector<InpMaterial> materials;
  std::vector<std::filesystem::path> included;  ///< files of *INCLUDE, each once
};

/// Reads *NODE, *ELEMENT of TYPE=C3D4, C3D10, C3D8, C3D20, C3D6, C3D15 and C3D5 with any letter behind, *NSET and
/// *ELSET (also GENERATE, and sets by name), with NSET= of *NODE and ELSET= of *ELEMENT; *SURFACE of element faces
/// (S1 to S6, and SPOS and SNEG of shells) or nodes, whose nodes become a node set; *MATERIAL, *ELASTIC, *DENSITY
/// (first line of each), *SOLID SECTION, and *INCLUDE (io/mesh/inp_lines.hpp), by `include`. Coordinates that a node
/// leaves out are 0, which a notice tells. Elements that are no solids are skipped and counted in a notice, but the
/// nodes of a set of them become a node set; other keywords are skipped with their lines. A set that names a node which
/// is not there is told in a notice, and refused by mesh::node_set(). A file does not contain its unit: coordinates
/// times `metres_per_unit` are m. `name` is the file's name in messages; names of sets are in capitals. Throws
/// DataError with file and line for a keyword that makes or moves nodes or elements and is not supported (*SYSTEM,
/// *NGEN, an *INSTANCE that moves …), another solid element, text in place of a number, a value that is not finite, an
/// element with a missing node, sets that together have over 6 million members and 60 times the number of nodes, or
/// that contain each other over two million times. A range of GENERATE may contain numbers of nodes that do not exist.
/// Cost O(bytes) and of the members of the sets.
[[nodiscard]] InpLabelled inp_mesh(std::string_view bytes, const std::string& name, double metres_per_unit,
                                   const InpInclude& include = included_file);

/// The file as tetrahedra, by mesh::solid_mesh() of inp_mesh(), with its materials.
[[nodiscard]] InpPart read_inp_part(const std::filesystem::path& path, double metres_per_unit);

/// The file as tetrahedra without its materials.
[[nodiscard]] mesh::SolidMesh read_inp(const std::filesystem::path& path, double metres_per_unit);

/// The values that a section lacks, such as "Young's modulus, density"; "" if it is complete.
[[nodiscard]] std::string what_lacks(const InpMaterial& material);

/// The material in SI (E in Pa, ρ in kg/m³) of a file whose unit of time is the second: E · kg / m, ρ · kg / m³, with
/// the metres in its unit of length and the kilograms in its unit of mass (for mm, t, s these are 1e-3 and 1e3).
[[nodiscard]] InpMaterial in_si(InpMaterial material, double metres_per_unit, double kg_per_mass_unit);

/// A homogeneous part whose natural modes are wanted.
struct InpFrequencyStep {
  double youngs_modulus_Pa = 0.0;
  double poisson_ratio = 0.0;
  double density_kg_m3 = 0.0;
  std::vector<std::string> fixed;  ///< sets whose nodes cannot move
  int modes = 10;
};

/// Writes nodes and elements of order 1 or 2 in SI, numbered from 1 in their order, the sets, and, if `step` is given,
/// a material and a *FREQUENCY step for CalculiX. Its fields are twenty characters wide, so that coordinates are
/// written with at least 14 significant digits (relative 5e-14). The file is written in one step. Throws InputError for
/// another order, a set whose name is empty or not possible in the format, or an unknown set in `fixed`; NumericalError
/// for a coordinate that is not finite; DataError if the file cannot be written.
void write_inp(const std::filesystem::path& path, const mesh::LagrangeNodes& nodes,
               const std::vector<mesh::NodeSet>& sets, const std::optional<InpFrequencyStep>& step = {});

}  // namespace thinwall::io

#pragma once
// The lines of an input file of Abaqus or CalculiX in its own numbers, from which io/mesh/inp.hpp makes a mesh.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh/inp_lines.hpp"
#include "mesh/solid/labelled_mesh.hpp"

namespace thinwall::io {

/// The labels first, first + step, … up to last; some labels of a range by GENERATE may not exist.
struct InpLabelRange {
  std::int64_t first = 0;
  std::int64_t last = 0;
  std::int64_t step = 1;
  int line = 0;
  bool gaps_allowed = false;
};

/// A set as ranges of labels, and the names of other sets that are part of it.
struct InpTextSet {
  std::vector<InpLabelRange> ranges;
  std::vector<std::string> others;
};

/// The face of a line of *SURFACE that is a whole shell, from either side (SPOS, SNEG).
inline constexpr int whole_shell = -1;

/// A line of *SURFACE: an element or a set of elements, and the number of the face, from 1; 0 for nodes.
struct InpTextFace {
  std::string set;  ///< empty: the element `label`
  std::int64_t label = 0;
  int face = 0;
  int line = 0;
};

/// A *MATERIAL: the first lines of *ELASTIC (isotropic) and *DENSITY, in the file's units.
struct InpTextMaterial {
  std::string name;
  std::optional<double> youngs_modulus;
  std::optional<double> poisson_ratio;
  std::optional<double> density;
};

/// A *SOLID SECTION, which gives a material to a set of elements.
struct InpTextSection {
  std::string element_set;
  std::string material;
  int line = 0;
};

/// An element that is no solid: its number, and the place of its nodes in flat_nodes.
struct InpTextFlat {
  std::int64_t label = 0;
  std::size_t first = 0;
  std::size_t nodes = 0;
};

/// The nodes, elements, sets and materials in the order of the file, with names in capitals.
struct InpText {
  mesh::LabelledMesh mesh;
  std::map<std::string, InpTextSet> node_sets;
  std::map<std::string, InpTextSet> element_sets;
  std::map<std::string, std::vector<InpTextFace>> surfaces;
  std::vector<InpTextFlat> flat;  ///< shells, beams …, for the nodes of their sets
  std::vector<std::int64_t> flat_nodes;
  std::vector<InpTextMaterial> materials;
  std::vector<InpTextSection> sections;
  std::vector<std::filesystem::path> included;  ///< files of *INCLUDE, each once
};

/// Reads the lines, coordinates times `metres_per_unit`, and those of included files, whose bytes `include` returns;
/// `name` is the file's name in messages, and included files lie in its folder. Throws DataError with file and line for
/// every fault that a line alone can have (listed in io/mesh/inp.hpp). Cost O(bytes).
[[nodiscard]] InpText inp_text(std::string_view bytes, const std::string& name, double metres_per_unit,
                               const InpInclude& include);

/// The text with a…z as A…Z, whatever the locale, because the format's names do not depend on case.
[[nodiscard]] std::string capitals(std::string_view text);

}  // namespace thinwall::io

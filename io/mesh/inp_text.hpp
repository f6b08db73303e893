#pragma once
// An input file of Abaqus or CalculiX in its own numbers, before it becomes a mesh (io/mesh/inp.hpp).

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/solid/labelled_mesh.hpp"

namespace thinwall::io {

/// Labels first, first + step, ... up to last; of a range by GENERATE some may be absent.
struct InpLabelRange {
  std::int64_t first = 0;
  std::int64_t last = 0;
  std::int64_t step = 1;
  int line = 0;
  bool gaps_allowed = false;
};

/// Ranges, and other sets that are part of it.
struct InpTextSet {
  std::vector<InpLabelRange> ranges;
  std::vector<std::string> others;
};

/// A line of *SURFACE: an element or a set of them, and the number of the face, from 1; of nodes 0.
struct InpTextFace {
  std::string set;  ///< empty: the element `label`
  std::int64_t label = 0;
  int face = 0;
  int line = 0;
};

/// *MATERIAL: the first line of *ELASTIC (isotropic) and *DENSITY, in the file's units.
struct InpTextMaterial {
  std::string name;
  std::optional<double> youngs_modulus;
  std::optional<double> poisson_ratio;
  std::optional<double> density;
};

/// *SOLID SECTION.
struct InpTextSection {
  std::string element_set;
  std::string material;
  int line = 0;
};

/// An element that is no solid: its number, and which of flat_nodes are its.
struct InpTextFlat {
  std::int64_t label = 0;
  std::size_t first = 0;
  std::size_t nodes = 0;
};

/// Nodes, elements, sets and materials in the order of the file; names in capitals.
struct InpText {
  mesh::LabelledMesh mesh;
  std::map<std::string, InpTextSet> node_sets;
  std::map<std::string, InpTextSet> element_sets;
  std::map<std::string, std::vector<InpTextFace>> surfaces;
  std::vector<InpTextFlat> flat;  ///< shells, beams, ...: for the nodes of their sets
  std::vector<std::int64_t> flat_nodes;
  std::vector<InpTextMaterial> materials;
  std::vector<InpTextSection> sections;
};

/// Reads the lines, coordinates times `metres_per_unit`; `name` is what messages call the file. Throws DataError with
/// file and line for whatever a line alone can have wrong (io/mesh/inp.hpp lists it). Cost O(bytes).
[[nodiscard]] InpText inp_text(std::string_view bytes, const std::string& name, double metres_per_unit);

/// a…z to A…Z, whatever the locale: the format's names do not depend on case.
[[nodiscard]] std::string capitals(std::string_view text);

}  // namespace thinwall::io

#pragma once
// Gmsh's numbers of element types, and the order of their nodes.
//
// Layout: Geuzaine & Remacle, Gmsh Reference Manual 4.8, "Node ordering".

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/solid/cell_shape.hpp"

namespace thinwall::io {

/// A type of element: points, lines and faces have dimension 0 to 2, of solids alone shape and order mean something.
struct GmshElement {
  std::size_t nodes = 0;  ///< 0: not read
  int dimension = 0;
  mesh::CellShape shape = mesh::CellShape::tetrahedron;
  /// For each node in the order of mesh/solid/cell_shape.hpp its place in Gmsh's.
  std::vector<std::size_t> order;
};

/// Types 1 to 19, which are all of order 1 and 2; others have no nodes here.
[[nodiscard]] const GmshElement& gmsh_element(std::int64_t type);

}  // namespace thinwall::io

#pragma once
// Gmsh's numbers of element types, and the order of their nodes.
//
// Layout: Geuzaine & Remacle, Gmsh Reference Manual 4.8, "Node ordering".

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/solid/cell_shape.hpp"

namespace thinwall::io {

/// A type of element. Points, lines and faces have dimension 0 to 2; shape and order are given for solids only.
struct GmshElement {
  std::size_t nodes = 0;  ///< 0 for a type that is not read
  int dimension = 0;
  mesh::CellShape shape = mesh::CellShape::tetrahedron;
  /// For each node in the order of mesh/solid/cell_shape.hpp its place in Gmsh's order.
  std::vector<std::size_t> order;
};

/// The element of a type, which is known for types 1 to 19, all of order 1 or 2; others have no nodes here.
[[nodiscard]] const GmshElement& gmsh_element(std::int64_t type);

}  // namespace thinwall::io

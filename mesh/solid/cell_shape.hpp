#pragma once
// The solid elements that other programs mesh with, and how their nodes are numbered here.
//
// The order is that of Abaqus and, but for wedges turned inside out, of VTK: corners, a node in each edge in the order
// of `edges`, a node in each four-sided face in the order of `faces`, a node in the middle of a hexahedron.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace thinwall::mesh {

/// Shapes of cells that are read and split.
enum class CellShape : std::uint8_t { tetrahedron, hexahedron, wedge, pyramid };

/// Corners, edges and faces of a shape by local numbers; faces run counterclockwise seen from outside.
struct CellTopology {
  const char* name = "";    ///< "tetrahedron"
  const char* plural = "";  ///< "tetrahedra"
  std::size_t corners = 0;
  std::vector<std::array<std::size_t, 2>> edges;
  std::vector<std::vector<std::size_t>> faces;
};

/// The topology of a shape, with 4 (tetrahedron), 8, 6 or 5 corners. The tetrahedron's edges are 01 12 20 03 13 23.
[[nodiscard]] const CellTopology& topology(CellShape shape);

/// The order of a cell with that many nodes: 1 with a node at each corner; 2 with one in each edge too, and possibly in
/// each four-sided face (and in the middle of a hexahedron); 0 for a number that is not known. Known are 4, 10; 8, 20,
/// 27; 6, 15, 18; 5, 13, 14.
[[nodiscard]] int cell_order(CellShape shape, std::size_t nodes);

}  // namespace thinwall::mesh

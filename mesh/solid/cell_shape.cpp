#include "mesh/solid/cell_shape.hpp"

#include <algorithm>

namespace thinwall::mesh {

const CellTopology& topology(CellShape shape) {
  static const std::array<CellTopology, 4> all{
      {{"tetrahedron",
        "tetrahedra",
        4,
        {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}},
        {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}},
       {"hexahedron",
        "hexahedra",
        8,
        {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}},
        {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}},
       {"wedge",
        "wedges",
        6,
        {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}},
        {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}},
       {"pyramid",
        "pyramids",
        5,
        {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}},
        {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}}}};
  return all[static_cast<std::size_t>(shape)];
}

int cell_order(CellShape shape, std::size_t nodes) {
  const CellTopology& cell = topology(shape);
  const auto four_sided = [](const std::vector<std::size_t>& face) { return face.size() == 4; };
  const auto quads = static_cast<std::size_t>(std::count_if(cell.faces.begin(), cell.faces.end(), four_sided));
  if (nodes == cell.corners) return 1;
  const std::size_t serendipity = cell.corners + cell.edges.size();
  const std::size_t full = serendipity + quads + (shape == CellShape::hexahedron ? 1 : 0);
  return nodes == serendipity || nodes == full ? 2 : 0;
}

}  // namespace thinwall::mesh

#include "io/mesh/gmsh_element.hpp"

#include <numeric>

namespace thinwall::io {

namespace {

using mesh::CellShape;

GmshElement in_order(std::size_t nodes, int dimension, CellShape shape = CellShape::tetrahedron) {
  GmshElement element{nodes, dimension, shape, std::vector<std::size_t>(nodes)};
  std::iota(element.order.begin(), element.order.end(), std::size_t{0});
  return element;
}

/// A solid with its corners first, then the given places of the nodes behind them.
GmshElement solid(CellShape shape, const std::vector<std::size_t>& behind_the_corners) {
  const std::size_t corners = mesh::topology(shape).corners;
  GmshElement element = in_order(corners, 3, shape);
  element.order.insert(element.order.end(), behind_the_corners.begin(), behind_the_corners.end());
  element.nodes = element.order.size();
  return element;
}

std::vector<GmshElement> all_types() {
  const std::vector<std::size_t> hex_edges{8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15};
  const std::vector<std::size_t> wedge_edges{6, 9, 7, 12, 14, 13, 8, 10, 11};
  const std::vector<std::size_t> pyramid_edges{5, 8, 10, 6, 7, 9, 11, 12};
  const auto with = [](std::vector<std::size_t> edges, const std::vector<std::size_t>& more) {
    edges.insert(edges.end(), more.begin(), more.end());
    return edges;
  };
  std::vector<GmshElement> all(20);
  all[1] = in_order(2, 1);
  all[2] = in_order(3, 2);
  all[3] = in_order(4, 2);
  all[4] = solid(CellShape::tetrahedron, {});
  all[5] = solid(CellShape::hexahedron, {});
  all[6] = solid(CellShape::wedge, {});
  all[7] = solid(CellShape::pyramid, {});
  all[8] = in_order(3, 1);
  all[9] = in_order(6, 2);
  all[10] = in_order(9, 2);
  all[11] = solid(CellShape::tetrahedron, {4, 5, 6, 7, 9, 8});
  all[12] = solid(CellShape::hexahedron, with(hex_edges, {20, 25, 21, 23, 24, 22, 26}));
  all[13] = solid(CellShape::wedge, with(wedge_edges, {15, 17, 16}));
  all[14] = solid(CellShape::pyramid, with(pyramid_edges, {13}));
  all[15] = in_order(1, 0);
  all[16] = in_order(8, 2);
  all[17] = solid(CellShape::hexahedron, hex_edges);
  all[18] = solid(CellShape::wedge, wedge_edges);
  all[19] = solid(CellShape::pyramid, pyramid_edges);
  return all;
}

}  // namespace

const GmshElement& gmsh_element(std::int64_t type) {
  static const std::vector<GmshElement> all = all_types();
  return all[type >= 1 && type < static_cast<std::int64_t>(all.size()) ? static_cast<std::size_t>(type) : 0];
}

}  // namespace thinwall::io

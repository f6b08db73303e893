// Nodes of a higher order on a given mesh, curved where it is, and sets of them.

#include <gtest/gtest.h>

#include <set>

#include "labelled_grids.hpp"
#include "mesh/solid/solid_mesh.hpp"

namespace thinwall::mesh {
namespace {

SolidMesh block(const PointMap& map) {
  return solid_mesh(LabelledGrid({3, 2, 1}, CellShape::hexahedron, 27, map).mesh);
}

/// A map of degree 2, which elements of order 2 carry without an error.
Eigen::Vector3d bent(const Eigen::Vector3d& x) {
  return {x.x() + 0.1 * x.y() * x.y(), x.y() - 0.2 * x.x() * x.x() + 0.05 * x.x() * x.z(), x.z() + 0.1 * x.x()};
}

// Nodes that stay on the straight lattice would be up to 5e-3 away.
TEST(NodesOfOrder, LieOnTheCurvedElements) {
  const SolidMesh straight = block([](const Eigen::Vector3d& x) { return x; });
  const SolidMesh curved = block(bent);
  ASSERT_GT(curved.midside_offset, 1e-3);
  for (const int order : {1, 2, 3, 4}) {
    const LagrangeNodes flat = lagrange_nodes(straight.mesh, order);
    const LagrangeNodes nodes = nodes_of_order(curved.mesh, curved.nodes, order);
    ASSERT_EQ(nodes.elements, flat.elements);
    double worst = 0.0;
    for (Eigen::Index i = 0; i < nodes.positions.rows(); ++i) {
      const Eigen::Vector3d expected = bent(flat.positions.row(i).transpose());
      worst = std::max(worst, (nodes.positions.row(i).transpose() - expected).norm());
    }
    EXPECT_LE(worst, 1e-14) << order;
  }
}

TEST(NodesOfOrder, ASetGrowsToTheNodesOfItsFaces) {
  const SolidMesh solid = block([](const Eigen::Vector3d& x) { return x; });
  const auto& left = node_set(solid, "LEFT", "grid").nodes;
  for (const int order : {2, 3, 5}) {
    const LagrangeNodes nodes = nodes_of_order(solid.mesh, solid.nodes, order);
    std::vector<int> expected;
    for (int i = 0; i < static_cast<int>(nodes.positions.rows()); ++i)
      if (nodes.positions(i, 0) < 1e-12) expected.push_back(i);
    EXPECT_EQ(set_of_order(solid.nodes, left, nodes), expected) << order;
  }
}

}  // namespace
}  // namespace thinwall::mesh

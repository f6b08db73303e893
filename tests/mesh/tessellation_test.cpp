#include "mesh/solid/tessellation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <set>

#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::mesh::tessellation_test {
namespace {

// Orientation and completeness in one: by the divergence theorem a closed surface seen from outside encloses the
// volume.
TEST(SurfaceTriangles, EncloseThePartAndUseEveryNodeOfItsSurface) {
  const Eigen::Vector3d size(0.3, 0.2, 0.1);
  const TetMesh mesh = kuhn_box(size, {2, 1, 1});
  for (int p = 1; p <= 6; ++p) {
    const LagrangeNodes nodes = lagrange_nodes(mesh, p);
    const auto triangles = surface_triangles(nodes, boundary(mesh));
    EXPECT_EQ(triangles.size(), boundary(mesh).size() * static_cast<std::size_t>(p * p));
    double volume = 0.0;
    std::set<int> used;
    for (const auto& [a, b, c] : triangles) {
      const auto x = [&](int node) { return Eigen::Vector3d(nodes.positions.row(node)); };
      volume += x(a).dot(x(b).cross(x(c))) / 6.0;
      used.insert({a, b, c});
    }
    EXPECT_NEAR(volume / size.prod(), 1.0, 1e-12) << "order " << p;
    std::set<int> on_surface;
    for (Eigen::Index i = 0; i < nodes.positions.rows(); ++i) {
      const Eigen::Array3d x = nodes.positions.row(i).transpose().array() / size.array();
      if ((x < 1e-9).any() || (x > 1.0 - 1e-9).any()) on_surface.insert(static_cast<int>(i));
    }
    EXPECT_EQ(used, on_surface) << "order " << p;
  }
}

}  // namespace
}  // namespace thinwall::mesh::tessellation_test

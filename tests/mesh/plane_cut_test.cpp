#include "mesh/solid/plane_cut.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::mesh::plane_cut_test {
namespace {

/// Area of the boundary, m²: a crack between elements adds to it.
double boundary_area(const TetMesh& mesh) {
  double area = 0.0;
  for (const auto& t : boundary(mesh)) {
    const auto v = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t.vertices[k])]; };
    area += 0.5 * (v(1) - v(0)).cross(v(2) - v(0)).norm();
  }
  return area;
}

TEST(CutAlong, LeavesNoElementOnBothSidesNoCrackAndTheSameBody) {
  const Eigen::Vector3d size(0.3, 0.2, 0.01);
  const TetMesh whole = kuhn_box(size, {6, 5, 1});
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Vector3d n = Eigen::Vector3d(unit(random), unit(random), unit(random)).normalized();
    const Eigen::Vector3d point = 0.5 * size + 0.3 * size.cwiseProduct(Eigen::Vector3d(unit(random), unit(random), 0));
    const TetMesh cut = cut_along(whole, {point, n});
    EXPECT_GT(cut.tets.size(), whole.tets.size());
    EXPECT_NEAR(volume(cut) / volume(whole), 1.0, 1e-12);
    EXPECT_NEAR(boundary_area(cut) / boundary_area(whole), 1.0, 1e-12) << "faces are divided alike from both sides";
    for (std::size_t t = 0; t < cut.tets.size(); ++t) {
      EXPECT_GT(volume(cut, static_cast<int>(t)), 0.0);
      double above = 0.0, below = 0.0;
      for (const int v : cut.tets[t]) {
        const double side = (cut.vertices[static_cast<std::size_t>(v)] - point).dot(n);
        above = std::max(above, side);
        below = std::max(below, -side);
      }
      EXPECT_LE(std::min(above, below), 1e-3 * 0.07) << "of the longest edge";
    }
  }
}

TEST(CutAlong, APlaneThroughVerticesOrBesideThePartChangesNothing) {
  const TetMesh whole = kuhn_box({0.3, 0.2, 0.1}, {3, 2, 1});
  for (const double x : {0.1, 0.10001, 0.5}) {
    const TetMesh cut = cut_along(whole, {{x, 0.0, 0.0}, {2.0, 0.0, 0.0}});
    EXPECT_EQ(cut.tets, whole.tets) << x;
    EXPECT_EQ(cut.vertices.size(), whole.vertices.size());
  }
}

}  // namespace
}  // namespace thinwall::mesh::plane_cut_test

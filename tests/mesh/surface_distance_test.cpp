#include "mesh/surface/surface_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.hpp"
#include "mesh/nearest_point.hpp"
#include "mesh/polyline.hpp"
#include "mesh/surface/shapes.hpp"
#include "mesh/surface/triangle_tree.hpp"
#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::mesh::surface_distance_test {
namespace {

TEST(SurfaceDistance, OfASurfaceToItselfTriangulatedOtherwiseIsNothing) {
  EXPECT_LT(surface_distance(block_surface({0.1, 0.06, 0.003}, 0.05), block_surface({0.1, 0.06, 0.003}, 0.007), 0.005),
            1e-15);
}

TEST(SurfaceDistance, SeesWhatOnlyOneOfTheTwoHas) {
  // A plate, and the same with a wall on it: from the plate to the other the wall is not seen.
  const TriangleSurface block = block_surface({0.1, 0.1, 0.01}, 0.01);
  TriangleSurface peak = block;
  for (auto& x : peak.vertices)
    if ((x - Eigen::Vector3d(0.05, 0.05, 0.01)).norm() < 1e-9) x(2) += 0.02;
  EXPECT_NEAR(one_sided_distance(peak, block, 0.005), 0.02, 1e-12);
  EXPECT_LT(one_sided_distance(block, peak, 0.005), 0.015);
  EXPECT_NEAR(surface_distance(block, peak, 0.005), 0.02, 1e-12);
}

TEST(SurfaceDistance, OfAPolygonToItsArcIsTheSagitta) {
  const CylinderSector sector{0.1, 0.003, 1.0, 0.02};
  const TriangleSurface fine = surface(sector, 0.0005);
  const TriangleSurface coarse = surface(sector, 0.0103);  // ten cells
  const double sagitta = 0.103 * (1.0 - std::cos(0.05));
  EXPECT_NEAR(surface_distance(fine, coarse, 0.001), sagitta, 0.02 * sagitta);
}

// A coarse spacing asks at corners, middles of edges and centroids only, which see a chord's sagitta and a raised
// corner.
TEST(SurfaceDistance, OfSmallTrianglesIsThatOfTheirCornersMiddlesAndCentres) {
  const CylinderSector sector{0.1, 0.003, 1.0, 0.02};
  const TriangleSurface fine = surface(sector, 0.0005), coarse = surface(sector, 0.0103);
  const double own = 0.103 * (1.0 - std::cos(0.5 / 206.0));  // of the fine one, of 206 cells
  EXPECT_NEAR(one_sided_distance(coarse, fine, 0.1), 0.103 * (1.0 - std::cos(0.05)), own);
  TriangleSurface peak = block_surface({0.1, 0.1, 0.01}, 0.01);
  peak.vertices.front() -= Eigen::Vector3d(0.003, 0.0, 0.0);
  EXPECT_NEAR(one_sided_distance(peak, block_surface({0.1, 0.1, 0.01}, 0.1), 0.1), 0.003, 1e-15);
}

TEST(SurfaceDistance, OfABlocksMeshToTheBlockIsNothing) {
  const TetMesh mesh = kuhn_box({0.3, 0.2, 0.1}, {3, 2, 2});
  const TriangleSurface skin = boundary_surface(mesh);
  EXPECT_EQ(skin.vertices.size(), 34U) << "4 · 3 · 3 grid points, two of them inside";
  EXPECT_LT(surface_distance(skin, block_surface({0.3, 0.2, 0.1}, 0.05), 0.02), 1e-15);
  EXPECT_THROW((void)surface_distance(skin, skin, 0.0), core::InputError);
}

TEST(TriangleTree, FindsTheNearestPointAndTheFirstWallThatARayMeets) {
  const TriangleSurface block = block_surface({0.1, 0.06, 0.003}, 0.02);
  const TriangleTree tree(block);
  const auto nearest = tree.nearest({0.033, 0.021, 0.008});
  EXPECT_LT((nearest.point - Eigen::Vector3d(0.033, 0.021, 0.003)).norm(), 1e-15);
  EXPECT_NEAR(nearest.distance_m, 0.005, 1e-15);
  EXPECT_NEAR(tree.first_hit({0.033, 0.021, 0.008}, {0, 0, -1}, -1).value_or(0.0), 0.005, 1e-15);
  EXPECT_NEAR(tree.first_hit(nearest.point, {0, 0, -1}, nearest.triangle).value_or(0.0), 0.003, 1e-15);
  EXPECT_FALSE(tree.first_hit({0.033, 0.021, 0.008}, {0, 0, 1}, -1).has_value());
}

TEST(TriangleTree, KnowsNoPointNearestToNowhere) {
  const TriangleSurface block = block_surface({0.1, 0.06, 0.003}, 0.05);
  EXPECT_THROW((void)TriangleTree(block).nearest({0.0, NAN, 0.0}), core::InputError);
}

TEST(TriangleTree, FindsWhatASearchOfAllTrianglesFinds) {
  const TriangleSurface blade = surface(Blade{}, 0.004);
  const TriangleTree tree(blade);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> in(-0.06, 0.12);
  for (int k = 0; k < 300; ++k) {
    const Eigen::Vector3d x{in(random), in(random), in(random)};
    EXPECT_NEAR(tree.nearest(x).distance_m, point_to_surface(blade, x).distance_m, 1e-15);
  }
}

// A ray from within a closed surface meets it, also at a corner or an edge; within a block it does so there.
TEST(TriangleTree, LetsNoRayPassBetweenTriangles) {
  for (const auto& part : {surface(Blade{}, 0.004), block_surface({0.1, 0.06, 0.003}, 0.02)}) {
    const TriangleTree tree(part);
    const bool convex = part.triangles.size() < 200;
    const Eigen::Vector3d from = centroid(part, 0) - 1e-4 * area_vector(part, 0).normalized();
    for (const auto& t : part.triangles) {
      const auto corner = [&](std::size_t k) { return part.vertices[static_cast<std::size_t>(t[k % 3])]; };
      for (std::size_t k = 0; k < 6; ++k) {
        const Eigen::Vector3d at = k < 3 ? corner(k) : Eigen::Vector3d(0.3 * corner(k) + 0.7 * corner(k + 1));
        const auto way = tree.first_hit(from, (at - from).normalized(), -1);
        ASSERT_TRUE(way) << at.transpose();
        if (convex) {
          EXPECT_NEAR(*way, (at - from).norm(), 1e-12);
        }
      }
    }
  }
}

TEST(TriangleTree, MeetsABlockAlongItsFaces) {
  const TriangleTree block(block_surface({0.1, 0.06, 0.003}, 0.02));
  EXPECT_NEAR(block.first_hit({-0.02, 0.02, 0.003}, {1, 0, 0}, -1).value_or(0.0), 0.02, 1e-15);
  EXPECT_NEAR(block.first_hit({0.05, 0.02, 0.0015}, {0, -1, 0}, -1).value_or(0.0), 0.02, 1e-15);
}

TEST(Polyline, KeepsThePointsThatItNeeds) {
  const Polyline line{{0, 0, 0}, {1, 0.001, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}};
  EXPECT_EQ(simplified(line, 0.01).size(), 3U);
  EXPECT_EQ(simplified(line, 0.0001).size(), 4U);
  EXPECT_LT((nearest_on(line, {3.0, 1.5, 0.0}) - Eigen::Vector3d(2, 1.5, 0)).norm(), 1e-15);
}

}  // namespace
}  // namespace thinwall::mesh::surface_distance_test

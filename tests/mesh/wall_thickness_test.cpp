#include "mesh/surface/wall_thickness.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "mesh/surface/closed_surface.hpp"
#include "mesh/surface/shapes.hpp"
#include "mesh/surface/surface_features.hpp"

namespace thinwall::mesh::wall_thickness_test {
namespace {

constexpr double thirty_degrees = std::numbers::pi / 6;

/// Largest relative error of the thickness over the triangles for which `wanted` gives one (> 0).
template <class Wanted>
double worst(const TriangleSurface& surface, const Wanted& wanted) {
  const auto thickness = wall_thickness(surface, TriangleTree(surface));
  double largest = 0.0;
  int counted = 0;
  for (int t = 0; t < static_cast<int>(surface.triangles.size()); ++t) {
    const double expected = wanted(centroid(surface, t), area_vector(surface, t).normalized());
    if (expected <= 0.0) continue;
    largest = std::max(largest, std::abs(thickness[static_cast<std::size_t>(t)] / expected - 1.0));
    ++counted;
  }
  EXPECT_GT(counted, 50);
  return largest;
}

TEST(WallThickness, OfAPlateIsExactOnBothFaces) {
  EXPECT_LT(worst(block_surface({0.15, 0.1, 0.003}, 0.01),
                  [](const auto&, const auto& normal) { return std::abs(normal(2)) > 0.9 ? 0.003 : 0.0; }),
            1e-12);
}

TEST(WallThickness, CanBeInterrupted) {
  const TriangleSurface surface = block_surface({0.15, 0.1, 0.003}, 0.01);
  const TriangleTree tree(surface);
  core::request_interrupt();
  EXPECT_THROW((void)wall_thickness(surface, tree), core::Interrupted);
  core::clear_interrupt();
}

TEST(WallThickness, OfACylinderSectorIsFoundToOnePercent) {
  EXPECT_LT(worst(surface(CylinderSector{}, 0.004),
                  [](const Eigen::Vector3d& x, const Eigen::Vector3d& normal) {
                    const double radial = std::abs(normal.head<2>().dot(x.head<2>().normalized()));
                    return radial > 0.99 ? 0.003 : 0.0;
                  }),
            0.01);
}

TEST(WallThickness, OfABladeFollowsItsTaperToTwoPercent) {
  const Blade blade;
  EXPECT_LT(worst(surface(blade, 0.004),
                  [&](const Eigen::Vector3d& x, const Eigen::Vector3d& normal) {
                    const double s = x(2) / blade.span_m;
                    const double across =
                        std::cos(blade.twist_rad * s) * normal(0) + std::sin(blade.twist_rad * s) * normal(1);
                    // Within a wall's width of a rim the rays run into it.
                    if (std::abs(across) < 0.9 || s < 0.06 || s > 0.96 || x.head<2>().norm() > 0.025) return 0.0;
                    return blade.root_thickness_m + s * (blade.tip_thickness_m - blade.root_thickness_m);
                  }),
            0.02);
}

TEST(WallThickness, MedianIsTheOneBeneathHalfOfTheArea) {
  const TriangleSurface pocket = surface(LPocket{}, 0.004);
  const auto thickness = wall_thickness(pocket, TriangleTree(pocket));
  std::vector<int> bottom;
  std::vector<int> outer_wall;
  for (int t = 0; t < static_cast<int>(pocket.triangles.size()); ++t) {
    const Eigen::Vector3d normal = area_vector(pocket, t).normalized();
    if (normal(2) < -0.9) bottom.push_back(t);
    if (normal(0) < -0.9) outer_wall.push_back(t);
  }
  EXPECT_NEAR(median_thickness(pocket, thickness, bottom), 0.004, 1e-12);
  EXPECT_NEAR(median_thickness(pocket, thickness, outer_wall), 0.003, 1e-12);
}

TEST(SurfaceFeatures, OfABlockAreSixPatchesTwelveLinesEightCorners) {
  const auto features = surface_features(block_surface({0.15, 0.1, 0.003}, 0.01), thirty_degrees);
  EXPECT_EQ(features.patches, 6);
  EXPECT_EQ(features.lines.size(), 12U);
  EXPECT_EQ(std::count(features.is_corner.begin(), features.is_corner.end(), true), 8);
}

// The ridges of a rhombic bar turn by 17 degrees only, and yet they are no part of a curve.
TEST(SurfaceFeatures, OfARhombicBarAreItsFourSidesToo) {
  TriangleSurface bar;
  for (const double z : {0.0, 0.2})
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.02, -0.003}, {0.04, 0.0}, {0.02, 0.003}})
      bar.vertices.emplace_back(x, y, z);
  bar.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}};
  for (int k = 0; k < 4; ++k) {
    const int next = (k + 1) % 4;
    bar.triangles.push_back({k, next, next + 4});
    bar.triangles.push_back({k, next + 4, k + 4});
  }
  require_closed(bar);
  const auto features = surface_features(bar, thirty_degrees);
  EXPECT_EQ(features.patches, 6);
  EXPECT_EQ(features.lines.size(), 12U);
}

/// A block of 200 x 100 x 4 mm whose upper face has one more vertex.
TriangleSurface block_with_vertex(const Eigen::Vector3d& on_top) {
  TriangleSurface block;
  for (const double z : {0.0, 0.004})
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.2, 0.0}, {0.2, 0.1}, {0.0, 0.1}})
      block.vertices.emplace_back(x, y, z);
  block.vertices.push_back(on_top);
  block.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 8}, {5, 6, 8}, {6, 7, 8}, {7, 4, 8}};
  for (int k = 0; k < 4; ++k) {
    const int next = (k + 1) % 4;
    block.triangles.push_back({k, next, next + 4});
    block.triangles.push_back({k, next + 4, k + 4});
  }
  require_closed(block);
  return block;
}

// Three micrometres from the border of the face a coordinate that is rounded turns the sliver beside it by 2e-3 rad.
TEST(SurfaceFeatures, OfARoundedBlockHaveNoPatchOfASliver) {
  const auto features = surface_features(block_with_vertex({0.1, 3e-6, 0.004 + 6e-9}), thirty_degrees);
  EXPECT_EQ(features.patches, 6);
  EXPECT_EQ(features.lines.size(), 12U);
}

TEST(SurfaceFeatures, OfALowPyramidAreItsFourRidgesToo) {
  const auto features = surface_features(block_with_vertex({0.1, 0.05, 0.01}), thirty_degrees);
  EXPECT_EQ(features.patches, 9);
  EXPECT_EQ(features.lines.size(), 16U);
}

TEST(SurfaceFeatures, OfACylinderSectorLeaveTheArcsWhole) {
  const auto features = surface_features(surface(CylinderSector{}, 0.005), thirty_degrees);
  EXPECT_EQ(features.patches, 6);
  EXPECT_EQ(features.lines.size(), 12U);
  EXPECT_EQ(std::count(features.is_corner.begin(), features.is_corner.end(), true), 8);
}

TEST(SurfaceFeatures, OfATriangulatedTubeAreClosedLinesWithoutCorners) {
  // A tube: a solid sector's cells around a full turn, here as two rings of 40 squares joined by rings.
  TriangleSurface tube;
  constexpr int n = 40;
  for (const double r : {0.05, 0.053}) {
    for (const double z : {0.0, 0.04}) {
      for (int i = 0; i < n; ++i) {
        const double a = 2 * std::numbers::pi * i / n;
        tube.vertices.emplace_back(r * std::cos(a), r * std::sin(a), z);
      }
    }
  }
  const auto ring = [&](int a, int b) {  // from ring a to ring b, seen from outside
    for (int i = 0; i < n; ++i) {
      const int j = (i + 1) % n;
      tube.triangles.push_back({a * n + i, a * n + j, b * n + j});
      tube.triangles.push_back({a * n + i, b * n + j, b * n + i});
    }
  };
  ring(2, 3);
  ring(3, 1);
  ring(1, 0);
  ring(0, 2);
  const auto features = surface_features(tube, thirty_degrees);
  EXPECT_EQ(features.patches, 4);
  ASSERT_EQ(features.lines.size(), 4U);
  for (const auto& line : features.lines) {
    EXPECT_EQ(line.vertices.size(), n + 1U);
    EXPECT_EQ(line.vertices.front(), line.vertices.back());
  }
  EXPECT_EQ(std::count(features.is_corner.begin(), features.is_corner.end(), true), 0);
}

}  // namespace
}  // namespace thinwall::mesh::wall_thickness_test

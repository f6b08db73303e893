#include "mesh/triangle_soup.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/error.hpp"
#include "mesh/surface/edge_uses.hpp"
#include "solid_shapes.hpp"
#include "tests/processor_time.hpp"

namespace thinwall::mesh::triangle_soup_test {
namespace {

TEST(TriangleSoup, MergesEqualPointsAndNoOthers) {
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, 0}, {1, 0, 1e-300}, {0, 1, 0}, {7, 7, 7}};
  soup.triangles = {{0, 1, 2}, {3, 4, 5}};
  const MergedPoints merged = merged_points(soup);
  EXPECT_EQ(merged.soup.triangles, (std::vector<std::array<int, 3>>{{0, 1, 2}, {0, 3, 2}})) << "-0 is 0, 1e-300 is not";
  EXPECT_EQ(merged.merged, 2);
  EXPECT_EQ(merged.first_merged, Eigen::Vector3d::Zero());
  EXPECT_EQ(merged.unused, 1);
  EXPECT_EQ(merged.first_unused, Eigen::Vector3d(7, 7, 7));
  EXPECT_EQ(merged.largest_way, 0.0);
}

// The independent algorithm compares every point with every earlier one that was kept.
TEST(TriangleSoup, MergesWithinATolerancesAsEveryPairComparedDoes) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const double tolerance : {0.05, 0.2, 0.7}) {
    TriangleSoup soup;
    for (int p = 0; p < 900; ++p) soup.points.emplace_back(unit(random), unit(random), unit(random));
    for (int t = 0; t < 300; ++t) soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    std::vector<Eigen::Vector3d> kept;
    double farthest = 0.0;
    std::vector<int> number;
    for (const auto& x : soup.points) {
      const auto near =
          std::find_if(kept.begin(), kept.end(), [&](const auto& y) { return (y - x).norm() <= tolerance; });
      number.push_back(static_cast<int>(near - kept.begin()));
      if (near == kept.end()) {
        kept.push_back(x);
      } else {
        farthest = std::max(farthest, (*near - x).norm());
      }
    }
    const MergedPoints merged = merged_points(soup, tolerance);
    EXPECT_EQ(merged.soup.points, kept);
    EXPECT_DOUBLE_EQ(merged.largest_way, farthest) << "a norm, whose sum the compiler may round in two ways";
    for (std::size_t p = 0; p < number.size(); ++p) EXPECT_EQ(merged.soup.triangles[p / 3][p % 3], number[p]);
  }
}

TEST(TriangleSoup, TakesCoordinatesBeyondAnyCell) {
  TriangleSoup soup;
  soup.points = {{1e300, 0, 0}, {-1e300, 0, 0}, {0, 1e300, 0}};
  soup.triangles = {{0, 1, 2}};
  EXPECT_EQ(merged_points(soup, 1e-9).merged, 0);
  EXPECT_THROW((void)merged_points(soup, -1.0), core::InputError);
}

// Bytes that are no surface make such points. All of them once shared one cell: a minute for 60 000.
TEST(TriangleSoup, MergesFarPointsInTimeAndOnlyEqualOnes) {
  TriangleSoup soup;
  constexpr int count = 50000;
  for (int p = 0; p < count; ++p) {
    const double far = (p % 2 == 0 ? 1e25 : -1e300) * (1.0 + p);
    soup.points.insert(soup.points.end(), {{far, 0.0, 1e20}, {0.0, far, 1.0 * p}, {far, 0.0, 1e20}});
    soup.triangles.push_back({3 * p, 3 * p + 1, 3 * p + 2});
  }
  const double start = tests::processor_seconds();
  const MergedPoints merged = merged_points(soup, 1e-3);
  EXPECT_LT(tests::processor_seconds() - start, 20.0);
  EXPECT_EQ(merged.merged, count);
  EXPECT_EQ(merged.largest_way, 0.0);
  EXPECT_EQ(merged.soup.points.size(), 2U * count);
}

TEST(TriangleSoup, TellsItsSize) {
  EXPECT_EQ(size_text(soup(block_surface({0.12, 0.08, 0.0125}, 0.02))), "120 x 80 x 12.5 mm");
  EXPECT_EQ(size_text({}), "0 x 0 x 0 mm");
}

TEST(EdgeUses, OfAClosedSurfaceAreTwoInOppositeDirections) {
  const TriangleSurface ring = torus(0.05, 0.02, 12, 8);
  int edges = 0;
  for_each_edge(sorted_edges(ring.triangles), [&](std::span<const EdgeUse> uses) {
    ++edges;
    ASSERT_EQ(uses.size(), 2U);
    EXPECT_NE(uses[0].is_forward, uses[1].is_forward);
  });
  // Euler: a torus has V - E + F = 0.
  EXPECT_EQ(edges, static_cast<int>(ring.vertices.size() + ring.triangles.size()));
}

}  // namespace
}  // namespace thinwall::mesh::triangle_soup_test

#include "mesh/polygon.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/mesh/plane_shapes.hpp"

namespace thinwall::mesh::polygon_test {
namespace {

TEST(Polygon, AreaHasTheSignOfItsOrientationAndLosesNothingFarFromTheOrigin) {
  Polygon polygon = regular({0.2, 0.1}, 0.03, 9);
  EXPECT_NEAR(signed_area(polygon), regular_area(0.03, 9), 1e-17);
  std::reverse(polygon.begin(), polygon.end());
  EXPECT_NEAR(signed_area(polygon), -regular_area(0.03, 9), 1e-17);
  EXPECT_EQ(signed_area(rectangle(1e6, 1e6, 1e6 + 0.5, 1e6 + 0.25)), 0.125);
}

TEST(Polygon, ContainsWhatLiesWithinItsCirclesOnly) {
  const Polygon polygon = regular({0.2, 0.1}, 0.03, 12);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> offset(-0.05, 0.05);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector2d p(0.2 + offset(random), 0.1 + offset(random));
    const double r = (p - Eigen::Vector2d(0.2, 0.1)).norm();
    EXPECT_TRUE(contains(polygon, p) || r >= 0.03 * std::cos(std::numbers::pi / 12));
    EXPECT_FALSE(contains(polygon, p) && r > 0.03);
  }
}

TEST(Polygon, SegmentsCrossProperlyOrNotAtAll) {
  const Segment a{Eigen::Vector2d(0, 0), Eigen::Vector2d(2, 2)};
  const auto p = crossing(a, {Eigen::Vector2d(0, 2), Eigen::Vector2d(2, 0)});
  ASSERT_TRUE(p);
  EXPECT_LT((*p - Eigen::Vector2d(1, 1)).norm(), 1e-15);
  EXPECT_FALSE(crossing(a, {Eigen::Vector2d(1, 1), Eigen::Vector2d(2, 0)})) << "touches with its end";
  EXPECT_NEAR(distance(a, Segment{Eigen::Vector2d(3, 2), Eigen::Vector2d(4, 0)}), 1.0, 1e-15);
}

/// A compiler that fuses products and sums makes a plain cross product of equal vectors differ from 0.
TEST(Polygon, SegmentsWithACommonEndDoNotCross) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> at(-0.3, 0.3);
  const auto point = [&] { return Eigen::Vector2d(at(random), at(random)); };
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector2d common = point();
    const Segment from{common, point()}, to{point(), common};
    EXPECT_FALSE(crossing(from, to));
    EXPECT_EQ(cross(from[1] - common, from[1] - common), 0.0);
  }
}

TEST(Polygon, SegmentsApartOnOneLineDoNotCrossByRoundOff) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> angle(0.0, 6.3);
  for (int i = 0; i < 20000; ++i) {
    const Polygon line = turned(Polygon{{0, 0.011}, {0.003, 0.011}, {0.007, 0.011}, {0.02, 0.011}}, angle(random));
    EXPECT_NEAR(distance(Segment{line[0], line[1]}, Segment{line[2], line[3]}), 0.004, 1e-15);
  }
}

}  // namespace
}  // namespace thinwall::mesh::polygon_test

// Polygons of any shape as triangles: they fill it, each place once.

#include "io/surface/ear_clipping.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "io/surface/obj.hpp"
#include "mesh/surface/surface_repair.hpp"

namespace thinwall::io::ear_clipping_test {
namespace {

using Corners = std::vector<Eigen::Vector2d>;

double cross(const Eigen::Vector2d& u, const Eigen::Vector2d& v) {
  return u.x() * v.y() - u.y() * v.x();
}

/// The shoelace formula.
double area(const Corners& corners) {
  double sum = 0.0;
  for (std::size_t k = 0; k < corners.size(); ++k) sum += 0.5 * cross(corners[k], corners[(k + 1) % corners.size()]);
  return sum;
}

/// The number of edges that a ray along +x crosses is odd within a polygon.
bool is_within(const Corners& corners, const Eigen::Vector2d& p) {
  bool within = false;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Eigen::Vector2d &a = corners[k], &b = corners[(k + 1) % corners.size()];
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      within = !within;
  }
  return within;
}

/// Expects n − 2 triangles that turn the right way, use every corner, and cover each of many random places once within
/// the polygon and not at all outside.
void expect_filled(const Corners& corners, const char* name) {
  const auto triangles = clipped_ears(corners);
  ASSERT_EQ(triangles.size(), corners.size() - 2) << name;
  std::vector<int> uses(corners.size(), 0);
  double sum = 0.0;
  for (const auto& [a, b, c] : triangles) {
    const double twice = cross(corners[b] - corners[a], corners[c] - corners[a]);
    EXPECT_GE(twice, 0.0) << name;
    sum += 0.5 * twice;
    for (const std::size_t k : {a, b, c}) ++uses[k];
  }
  for (const int count : uses) EXPECT_GE(count, 1) << name;
  EXPECT_NEAR(sum, area(corners), 1e-12 * area(corners)) << name;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-4.0, 5.0);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector2d p(place(random), place(random));
    int covered = 0;
    for (const auto& [a, b, c] : triangles) covered += is_within({corners[a], corners[b], corners[c]}, p) ? 1 : 0;
    EXPECT_EQ(covered, is_within(corners, p) ? 1 : 0) << name << " at " << p.transpose();
  }
}

Corners spiral(int corners, double turns) {
  Corners outline;
  const int half = corners / 2;
  for (int k = 0; k < half; ++k) {
    const double angle = 2.0 * std::numbers::pi * turns * k / (half - 1);
    outline.push_back((0.5 + 0.45 * angle / (2.0 * std::numbers::pi)) *
                      Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  for (int k = half; k-- > 0;) {
    const double angle = 2.0 * std::numbers::pi * turns * k / (half - 1);
    outline.push_back((0.3 + 0.45 * angle / (2.0 * std::numbers::pi)) *
                      Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  if (area(outline) < 0.0) outline = Corners(outline.rbegin(), outline.rend());
  return outline;
}

TEST(EarClipping, FillsWhatNoFanFills) {
  expect_filled({{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {4, 3}, {4, 4}, {0, 4}}, "a C");
  expect_filled(spiral(60, 3.0), "a spiral");
  expect_filled(spiral(1000, 6.5), "a long spiral");
  Corners comb;
  for (int tooth = 0; tooth < 40; ++tooth) {
    for (const double y : {0.0, 3.0}) comb.emplace_back(0.1 * tooth, y);
    for (const double y : {3.0, 0.0}) comb.emplace_back(0.1 * tooth + 0.05, y);
  }
  comb.emplace_back(4.0, -1.0);
  comb.emplace_back(-1.0, -1.0);
  expect_filled(Corners(comb.rbegin(), comb.rend()), "a comb, whose gaps have corners on one line");
}

TEST(EarClipping, FillsRandomStars) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> radius(0.05, 4.0);
  for (int corners = 4; corners < 120; ++corners) {
    Corners star;
    for (int k = 0; k < corners; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / corners;
      star.push_back(radius(random) * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
    expect_filled(star, "a star");
  }
}

/// A square with a square hole, to which a slit leads whose two sides are at one place.
TEST(EarClipping, FillsAroundAHoleWithASlit) {
  expect_filled({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}}, "a frame");
}

TEST(EarClipping, RefusesAnOutlineThatCrossesItself) {
  EXPECT_TRUE(clipped_ears({{0, 0}, {4, 0}, {1, 3}, {3, 3}}).empty()) << "a bow tie, the larger wing below";
  EXPECT_TRUE(clipped_ears({{0, 0}, {0, 1}, {1, 0}}).empty()) << "turned the other way";
  EXPECT_TRUE(clipped_ears({{0, 0}, {1, 0}, {2, 0}, {3, 0}}).empty()) << "on one line";
}

/// A bracket with the outline of a C, which an OBJ file has as two facets of eight corners and eight sides, closes.
TEST(EarClipping, GivesAClosedSurfaceOfAnObjFile) {
  std::string text;
  const char* outline[] = {"0 0", "4 0", "4 1", "1 1", "1 3", "4 3", "4 4", "0 4"};
  for (const char* z : {" 0", " 2"})
    for (const char* xy : outline) text += "v " + std::string(xy) + z + "\n";
  text += "f 8 7 6 5 4 3 2 1\nf 9 10 11 12 13 14 15 16\n";
  for (int k = 0; k < 8; ++k) {
    const int a = k + 1, b = (k + 1) % 8 + 1;
    text += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(b + 8) + " " +
            std::to_string(a + 8) + "\n";
  }
  const mesh::SurfaceRepair repaired = mesh::repaired_surface(obj_surface(text, "bracket.obj", 1.0), {});
  EXPECT_NEAR(repaired.volume_m3, 20.0, 1e-12);
}

}  // namespace
}  // namespace thinwall::io::ear_clipping_test

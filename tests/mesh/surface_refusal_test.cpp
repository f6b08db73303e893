// What is no surface of one body is refused in one line that says what, how often and where.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <limits>
#include <random>
#include <string>

#include "core/error.hpp"
#include "mesh/surface/closed_surface.hpp"
#include "mesh/surface/surface_repair.hpp"
#include "solid_shapes.hpp"

namespace thinwall::mesh::surface_refusal_test {
namespace {

std::string refusal(const TriangleSoup& soup, const SurfaceRepairOptions& options = {}) {
  try {
    (void)repaired_surface(soup, options);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "no error";
}

void expect_refused(const TriangleSoup& soup, const std::string& what, const std::string& where,
                    const SurfaceRepairOptions& options = {}) {
  const std::string text = refusal(soup, options);
  EXPECT_NE(text.find(what), std::string::npos) << text;
  EXPECT_NE(text.find(where), std::string::npos) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos) << "one line";
}

const TriangleSurface cube = block_surface({0.1, 0.1, 0.1}, 0.1);

TriangleSurface small_cube(double edge) {
  return block_surface({edge, edge, edge}, edge);
}

TEST(SurfaceRefusal, AnOpenSurfaceIsNamedWithItsEdges) {
  TriangleSoup open = soup(block_surface({0.1, 0.1, 0.1}, 0.05));
  open.triangles.pop_back();
  expect_refused(open, "3 edges with one triangle: the surface is open", "100) mm");
}

TEST(SurfaceRefusal, SelfIntersectionIsNamed) {
  TriangleSurface crossed = block_surface({0.1, 0.1, 0.02}, 0.02);
  for (auto& x : crossed.vertices)
    if ((x - Eigen::Vector3d(0.04, 0.04, 0.02)).norm() < 1e-9) x(2) = -0.01;
  expect_refused(soup(crossed), "pairs of triangles that cross or cover each other", "the first at (");
}

TEST(SurfaceRefusal, SeveralBodiesAreNamedWithAPointOfTheSmaller) {
  expect_refused(together(cube, small_cube(0.05), {1.0, 0.0, 0.0}), "1 bodies beside the largest", "(1000, 0, 0) mm");
  expect_refused(together(small_cube(0.05), cube, {1.0, 0.0, 0.0}), "1 bodies beside the largest", "(0, 0, 0) mm");
}

TEST(SurfaceRefusal, ANestedCavityIsToldFromABody) {
  expect_refused(together(cube, small_cube(0.05), {0.02, 0.02, 0.02}), "1 closed cavities", "(20, 20, 20) mm");
}

TEST(SurfaceRefusal, ACoincidentFinIsAWallWithoutThickness) {
  TriangleSoup fin = soup(cube);
  const int top = static_cast<int>(fin.points.size());
  fin.points.emplace_back(0.05, 0.05, 0.2);
  const auto corner = [&](const Eigen::Vector3d& x) {
    for (std::size_t p = 0; p < fin.points.size(); ++p)
      if ((fin.points[p] - x).norm() < 1e-12) return static_cast<int>(p);
    return -1;
  };
  const int a = corner({0.0, 0.0, 0.1});
  const int b = corner({0.1, 0.0, 0.1});
  fin.triangles.push_back({a, b, top});
  fin.triangles.push_back({b, a, top});
  expect_refused(fin, "1 facets that coincide with another that looks the other way", "mm");
  // A sheet seen from both sides.
  TriangleSoup sheet;
  sheet.points = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0.1, 0.1, 0}};
  sheet.triangles = {{0, 1, 2}, {1, 3, 2}, {0, 2, 1}, {1, 2, 3}};
  expect_refused(sheet, "a wall without thickness", "0) mm");
}

TEST(SurfaceRefusal, CoincidentFacetsWithOtherTrianglesCoverEachOther) {
  // A sheet whose two sides are cut along different diagonals: no facet stands twice, each covers others.
  TriangleSoup sheet;
  sheet.points = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0.1, 0.1, 0}};
  sheet.triangles = {{0, 1, 2}, {1, 3, 2}, {0, 3, 1}, {0, 2, 3}};
  expect_refused(sheet, "cover each other", "0) mm");
}

TEST(SurfaceRefusal, BodiesThatShareAnEdgeOrAPointAreNamed) {
  expect_refused(together(cube, cube, {0.1, 0.1, 0.0}), "1 edges in which more than two triangles meet",
                 "(100, 100, 50) mm");
  expect_refused(together(cube, cube, {0.1, 0.1, 0.1}), "1 points in which parts of the surface touch",
                 "(100, 100, 100) mm");
}

TEST(SurfaceRefusal, AOneSidedSurfaceIsNamed) {
  // The projective plane on six points: every edge in two triangles, no orientation (Möbius 1886).
  TriangleSoup plane;
  plane.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0.3}, {0.4, 1, 1}};
  plane.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1},
                     {1, 2, 4}, {2, 3, 5}, {3, 4, 1}, {4, 5, 2}, {5, 1, 3}};
  expect_refused(plane, "the surface is one-sided", "mm");
}

TEST(SurfaceRefusal, AWallBelowTheToleranceIsNamedWithItsThickness) {
  SurfaceRepairOptions options;
  options.thinnest_wall_m = 1e-3;
  const TriangleSurface plate = block_surface({0.1, 0.08, 0.0005}, 0.01);
  expect_refused(soup(plate), "a wall thinner than 1 mm, the thinnest 0.5 mm", "mm", options);
  options.thinnest_wall_m = 4e-4;
  EXPECT_NEAR(repaired_surface(soup(plate), options).thinnest_wall_m, 5e-4, 1e-15);
  // The rib's floor is 2/1024 m, its walls 4/1024 m, everything else thicker.
  options.thinnest_wall_m = 1.99 / 1024;
  EXPECT_NEAR(repaired_surface(soup(pocketed_rib()), options).thinnest_wall_m, 2.0 / 1024, 1e-15);
  options.thinnest_wall_m = 2.01 / 1024;
  expect_refused(soup(pocketed_rib()), "the thinnest 1.95 mm", "mm", options);
  // Small facets in the corners of a cube are near other faces, but there is no wall.
  options.thinnest_wall_m = 0.09;
  EXPECT_NEAR(repaired_surface(soup(block_surface({0.1, 0.1, 0.1}, 0.005)), options).thinnest_wall_m, 0.1, 1e-15);
  // What encloses nothing at all is refused without being asked.
  EXPECT_NE(refusal(soup(block_surface({0.1, 0.1, 1e-12}, 0.1))), "no error");
}

TEST(SurfaceRefusal, ARepairThatMovesTheSurfaceTooFarIsNamed) {
  TriangleSoup cracked = soup(cube);
  cracked.points.push_back(cracked.points[0] + Eigen::Vector3d(1e-4, 0.0, 0.0));
  for (auto& t : cracked.triangles) {
    const auto found = std::find(t.begin(), t.end(), 0);
    if (found == t.end()) continue;
    *found = static_cast<int>(cracked.points.size()) - 1;
    break;
  }
  SurfaceRepairOptions options;
  options.merge_tolerance_m = 2e-4;
  expect_refused(cracked, "moves the surface by 0.1 mm, more than 0.0173 mm", "merge within less", options);
  options.largest_movement = 1e-3;
  EXPECT_NEAR(repaired_surface(cracked, options).largest_movement_m, 1e-4, 1e-15);
}

TEST(SurfaceRefusal, CoordinatesBeyondTheDigitsOfADoubleAreNamed) {
  TriangleSoup far = soup(cube);
  for (auto& x : far.points) x(0) += 1e9;
  expect_refused(far, "diagonals from the origin", "too far to resolve");
}

TEST(SurfaceRefusal, ASizeThatNoPartHasIsNamedWithItsFarthestPoint) {
  TriangleSoup stray = soup(cube);
  stray.points[3](1) = 3e35;  // 3e38 mm, the largest number of a file in single precision
  expect_refused(stray, "reaches to", "3e+38");
  TriangleSoup small = soup(cube);
  for (auto& x : small.points) x *= 1e-30;
  expect_refused(small, "no part is that small", "check the unit");
}

TEST(SurfaceRefusal, NumbersThatAreNoneAndPointsThatAreNotThereAreNamed) {
  TriangleSoup bad = soup(cube);
  bad.points[3](1) = std::numeric_limits<double>::quiet_NaN();
  expect_refused(bad, "a corner that is not finite", "nan");
  bad = soup(cube);
  bad.triangles[4][1] = 99;
  expect_refused(bad, "triangle 4 of the surface names point 99 of 8", "from 0");
  expect_refused({}, "no triangles", "closed");
  SurfaceRepairOptions options;
  options.largest_hole_edges = 1000;
  expect_refused(soup(cube), "largest_hole_edges", "0 to 100", options);
  options = {};
  options.merge_tolerance_m = -1.0;
  expect_refused(soup(cube), "merge_tolerance_m", "0 to", options);
}

/// True if the soup was mended, and then soundly; false if it was refused.
bool is_mended(const TriangleSoup& soup, const SurfaceRepairOptions& options) {
  SurfaceRepair repair;
  try {
    repair = repaired_surface(soup, options);
  } catch (const core::InputError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return false;
  }
  EXPECT_NO_THROW(require_closed(repair.surface));
  return true;
}

// On a grid of 27 points triangles coincide, degenerate, cross and touch in every way.
TEST(SurfaceRefusal, TrianglesAtRandomOnAFewPointsAreMendedSoundlyOrRefused) {
  std::mt19937 random(27);
  SurfaceRepairOptions options;
  int mended = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    TriangleSoup soup;
    for (int p = 0; p < 27; ++p) soup.points.emplace_back(p % 3, p / 3 % 3, p / 9);
    std::shuffle(soup.points.begin(), soup.points.end(), random);
    const int points = 4 + static_cast<int>(random() % (trial % 2 == 0 ? 2 : 24));
    const int triangles = 4 + static_cast<int>(random() % 40);
    for (int t = 0; t < triangles; ++t) {
      std::array<int, 3> corners{};
      for (int& p : corners) p = static_cast<int>(random()) & 0x7fffffff;
      for (int& p : corners) p %= points;
      soup.triangles.push_back(corners);
    }
    options.largest_hole_edges = static_cast<int>(random() % 2) * 12;
    options.merge_tolerance_m = random() % 4 == 0 ? 1e-4 : 0.0;
    mended += is_mended(soup, options) ? 1 : 0;
  }
  std::printf("%d of 3000 soups became surfaces\n", mended);
  EXPECT_GT(mended, 100);
}

// Columns of three heights, which may touch in an edge; facets removed, doubled, turned, moved.
TEST(SurfaceRefusal, ShapesDamagedAtRandomAreMendedSoundlyOrRefused) {
  std::mt19937 random(28);
  SurfaceRepairOptions options;
  int mended = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const unsigned int present = random();
    const GridLines lines{divided(0, 1, 3), divided(0, 1, 3), divided(0, 1, 3)};
    const auto is_filled = [&](int i, int j, int k) {
      return k <= static_cast<int>((present >> (6 * i + 2 * j)) & 3U);
    };
    TriangleSoup soup = mesh::soup(grid_surface(lines, is_filled));
    const auto any = [&] { return random() % soup.triangles.size(); };
    for (unsigned int k = random() % 3; k > 0; --k) soup.triangles.push_back(soup.triangles[any()]);
    for (unsigned int k = random() % 8; k > 0; --k) std::swap(soup.triangles[any()][0], soup.triangles[any()][1]);
    if (random() % 3 == 0) soup.triangles.erase(soup.triangles.begin() + static_cast<std::ptrdiff_t>(any()));
    if (random() % 4 == 0) soup.triangles[any()][random() % 3] = soup.triangles[any()][random() % 3];
    options.largest_hole_edges = static_cast<int>(random() % 2) * 8;
    mended += is_mended(soup, options) ? 1 : 0;
  }
  std::printf("%d of 500 shapes became surfaces\n", mended);
  EXPECT_GT(mended, 20);
}

TEST(SurfaceRefusal, ASurfaceThatCoversItselfEverywhereComesBackInTime) {
  // 2000 tetrahedra in one another: every pair of triangles crosses or nearly so.
  TriangleSoup heap;
  for (int k = 0; k < 2000; ++k) {
    const double size = 1.0 + 1e-4 * k;
    const int first = 4 * k;
    heap.points.insert(heap.points.end(), {{0, 0, 0.01 * size}, {size, 0, 0}, {0, size, 0}, {0, 0, size}});
    heap.triangles.insert(heap.triangles.end(), {{first, first + 2, first + 1},
                                                 {first, first + 1, first + 3},
                                                 {first, first + 3, first + 2},
                                                 {first + 1, first + 2, first + 3}});
  }
  SurfaceRepairOptions options;
  options.limits.time_s = 20.0;
  options.longest_union_s = 1.0;
  const auto start = std::chrono::steady_clock::now();
  const std::string text = refusal(heap, options);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 120.0);
  EXPECT_NE(text, "no error");
}

}  // namespace
}  // namespace thinwall::mesh::surface_refusal_test

// What is mended, and that the surface is then the one that was damaged.

#include "mesh/surface/surface_repair.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "core/error.hpp"
#include "mesh/surface/closed_surface.hpp"
#include "mesh/surface/surface_distance.hpp"
#include "mesh/volume/surface_to_volume.hpp"
#include "solid_shapes.hpp"

namespace thinwall::mesh::surface_repair_test {
namespace {

struct Shape {
  const char* name;
  TriangleSurface surface;
};

std::vector<Shape> shapes() {
  return {{"cube", block_surface({0.1, 0.1, 0.1}, 0.05)},
          {"torus", torus(0.05, 0.02, 24, 12)},
          {"pocketed rib", pocketed_rib()}};
}

/// Each triangle turned over with probability one half.
int turn_some(TriangleSoup& soup, std::mt19937& random) {
  int turned = 0;
  for (auto& t : soup.triangles) {
    if (random() % 2 == 0) continue;
    std::swap(t[0], t[1]);
    ++turned;
  }
  return turned;
}

/// Every triangle with points of its own.
TriangleSoup exploded(const TriangleSoup& whole) {
  TriangleSoup result;
  for (const auto& t : whole.triangles) {
    const int first = static_cast<int>(result.points.size());
    for (const int p : t) result.points.push_back(whole.points[static_cast<std::size_t>(p)]);
    result.triangles.push_back({first, first + 1, first + 2});
  }
  return result;
}

int count_of(const SurfaceRepair& repair, const std::string& what) {
  for (const auto& finding : repair.mended)
    if (finding.what.find(what) != std::string::npos) return finding.count;
  return 0;
}

/// Volume to round-off: a sum of n terms, each at most the volume of the block around it.
void expect_same(const TriangleSurface& repaired, const TriangleSurface& original) {
  EXPECT_NO_THROW(require_closed(repaired));
  EXPECT_NEAR(volume(repaired) / volume(original), 1.0, 1e-12);
  EXPECT_LT(surface_distance(repaired, original, diagonal(original) / 10), 1e-12 * diagonal(original));
}

TEST(SurfaceRepair, LeavesASoundSurfaceAsItIs) {
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    const auto repair = repaired_surface(soup(shape.surface));
    EXPECT_EQ(text(repair), "nothing to mend");
    EXPECT_EQ(repair.surface.triangles.size(), shape.surface.triangles.size());
    EXPECT_EQ(repair.largest_movement_m, 0.0);
    EXPECT_EQ(repair.moved_by, Eigen::Vector3d::Zero());
    EXPECT_EQ(repair.volume_m3, volume(repair.surface));
    expect_same(repair.surface, shape.surface);
  }
}

TEST(SurfaceRepair, TurnsFacetsBack) {
  std::mt19937 random(6);
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    for (int trial = 0; trial < 5; ++trial) {
      TriangleSoup damaged = soup(shape.surface);
      const int turned = turn_some(damaged, random);
      const auto repair = repaired_surface(damaged);
      EXPECT_EQ(count_of(repair, "turned over"), turned) << "no more and no fewer than were turned";
      expect_same(repair.surface, shape.surface);
    }
    TriangleSoup inside_out = soup(shape.surface);
    for (auto& t : inside_out.triangles) std::swap(t[0], t[1]);
    EXPECT_EQ(count_of(repaired_surface(inside_out), "turned over"), static_cast<int>(inside_out.triangles.size()));
  }
}

TEST(SurfaceRepair, DropsDoubleFacetsWhicheverWayTheyRun) {
  std::mt19937 random(7);
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    TriangleSoup damaged = soup(shape.surface);
    for (int k = 0; k < 30; ++k) {
      auto copy = damaged.triangles[random() % damaged.triangles.size()];
      std::rotate(copy.begin(), copy.begin() + random() % 3, copy.end());
      if (random() % 2 == 0) std::swap(copy[0], copy[1]);
      damaged.triangles.push_back(copy);
    }
    std::shuffle(damaged.triangles.begin(), damaged.triangles.end(), random);
    const auto repair = repaired_surface(damaged);
    EXPECT_EQ(count_of(repair, "more than once"), 30);
    expect_same(repair.surface, shape.surface);
  }
}

TEST(SurfaceRepair, MergesSplitPoints) {
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    const TriangleSoup damaged = exploded(soup(shape.surface));
    const auto repair = repaired_surface(damaged);
    EXPECT_EQ(count_of(repair, "lay on another"),
              static_cast<int>(damaged.points.size() - shape.surface.vertices.size()));
    EXPECT_EQ(repair.surface.vertices.size(), shape.surface.vertices.size());
    EXPECT_EQ(repair.largest_movement_m, 0.0);
    expect_same(repair.surface, shape.surface);
  }
}

TEST(SurfaceRepair, MergesWithinATolerancesOnlyIfAskedAndSaysHowFar) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> way(-2e-9, 2e-9);
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    TriangleSoup cracked = exploded(soup(shape.surface));
    for (auto& x : cracked.points) x += Eigen::Vector3d(way(random), way(random), way(random));
    EXPECT_THROW((void)repaired_surface(cracked), core::InputError) << "open along every edge";
    SurfaceRepairOptions options;
    options.merge_tolerance_m = 2e-8;
    const auto repair = repaired_surface(cracked, options);
    EXPECT_NO_THROW(require_closed(repair.surface));
    EXPECT_GT(repair.largest_movement_m, 1e-9);
    EXPECT_LE(repair.largest_movement_m, 4e-9 * std::sqrt(3.0)) << "twice the farthest that a point was moved";
    EXPECT_NEAR(repair.volume_m3 / volume(shape.surface), 1.0, 1e-6);
  }
}

TEST(SurfaceRepair, DropsCollapsedFacetsAndUnusedPoints) {
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    TriangleSoup damaged = soup(shape.surface);
    damaged.triangles.push_back({3, 3, 5});
    damaged.triangles.push_back({4, 4, 4});
    damaged.points.emplace_back(1.0, 2.0, 3.0);
    const auto repair = repaired_surface(damaged);
    EXPECT_EQ(count_of(repair, "two corners in one point"), 2);
    EXPECT_EQ(count_of(repair, "no facet uses"), 1);
    EXPECT_EQ(repair.surface.vertices.size(), shape.surface.vertices.size());
    expect_same(repair.surface, shape.surface);
  }
}

/// Splits an edge at points that only one of its two triangles uses; flat triangles close the gap, as exporters do.
TriangleSoup with_flat_facets(const TriangleSurface& surface, int points) {
  TriangleSoup damaged = soup(surface);
  const auto whole = damaged.triangles[0];
  const Eigen::Vector3d a = damaged.points[static_cast<std::size_t>(whole[0])];
  const Eigen::Vector3d b = damaged.points[static_cast<std::size_t>(whole[1])];
  int previous = whole[0];
  damaged.triangles.erase(damaged.triangles.begin());
  for (int k = 1; k <= points; ++k) {
    const int added = static_cast<int>(damaged.points.size());
    damaged.points.emplace_back(a + (b - a) * (k / 8.0));
    damaged.triangles.push_back({previous, added, whole[2]});
    damaged.triangles.push_back({added, previous, whole[1]});
    previous = added;
  }
  damaged.triangles.push_back({previous, whole[1], whole[2]});
  return damaged;
}

TEST(SurfaceRepair, SplitsTheNeighboursOfFacetsWithoutArea) {
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    for (const int points : {1, 3}) {
      // The flat triangles (added, previous, b) close it: previous-b is the edge that the one before left.
      const TriangleSoup damaged = with_flat_facets(shape.surface, points);
      const auto repair = repaired_surface(damaged);
      EXPECT_EQ(count_of(repair, "without area"), points);
      EXPECT_EQ(repair.surface.triangles.size(), shape.surface.triangles.size() + 2 * static_cast<std::size_t>(points));
      expect_same(repair.surface, shape.surface);
    }
  }
}

TEST(SurfaceRepair, FillsSmallHolesOnlyIfAsked) {
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    TriangleSoup open = soup(shape.surface);
    open.triangles.erase(open.triangles.begin() + 7);
    EXPECT_THROW((void)repaired_surface(open), core::InputError);
    SurfaceRepairOptions options;
    options.largest_hole_edges = 3;
    const auto repair = repaired_surface(open, options);
    EXPECT_EQ(count_of(repair, "holes filled"), 1);
    expect_same(repair.surface, shape.surface);
  }
  // A hole of eight edges on the cube's face, flat, and not filled if only seven are allowed.
  const TriangleSurface cube = block_surface({0.1, 0.1, 0.1}, 0.025);
  TriangleSoup open = soup(cube);
  std::erase_if(open.triangles, [&](const auto& t) {
    return std::any_of(t.begin(), t.end(), [&](int p) {
      return (open.points[static_cast<std::size_t>(p)] - Eigen::Vector3d(0.05, 0.05, 0.1)).norm() < 1e-9;
    });
  });
  SurfaceRepairOptions options;
  options.largest_hole_edges = 8;
  const auto repair = repaired_surface(open, options);
  EXPECT_EQ(count_of(repair, "points that no facet uses"), 1);
  EXPECT_NEAR(repair.volume_m3, 1e-3, 1e-15);
  EXPECT_NO_THROW(require_closed(repair.surface));
  options.largest_hole_edges = 5;
  EXPECT_THROW((void)repaired_surface(open, options), core::InputError);
}

TEST(SurfaceRepair, OfAllDamagesTogetherGivesTheSurfaceBack) {
  std::mt19937 random(9);
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    for (int trial = 0; trial < 10; ++trial) {
      TriangleSoup damaged = with_flat_facets(shape.surface, 1);
      for (int k = 0; k < 10; ++k) damaged.triangles.push_back(damaged.triangles[random() % damaged.triangles.size()]);
      turn_some(damaged, random);
      std::shuffle(damaged.triangles.begin(), damaged.triangles.end(), random);
      const auto repair = repaired_surface(exploded(damaged));
      expect_same(repair.surface, shape.surface);
    }
  }
}

TEST(SurfaceRepair, MovesAPartThatIsFarFromTheOriginAndSaysSo) {
  const TriangleSurface near = pocketed_rib();
  TriangleSoup far = soup(near);
  const Eigen::Vector3d by(1024.0, -512.0, 256.0);  // powers of two: the coordinates stay exact
  for (auto& x : far.points) x += by;
  const auto repair = repaired_surface(far);
  EXPECT_EQ(count_of(repair, "moved to its centre"), 1);
  EXPECT_NE(text(repair).find("diagonals from the origin"), std::string::npos);
  for (const auto& x : repair.surface.vertices) EXPECT_LT(x.norm(), diagonal(near));
  TriangleSurface back = repair.surface;
  for (auto& x : back.vertices) x -= repair.moved_by + by;
  expect_same(back, near);
  SurfaceRepairOptions options;
  options.far_diagonals = 1e6;
  EXPECT_EQ(repaired_surface(far, options).moved_by, Eigen::Vector3d::Zero());
}

TEST(SurfaceRepair, OfAPocketedRibIsMeshedToItsVolume) {
  std::mt19937 random(10);
  TriangleSoup damaged = exploded(soup(pocketed_rib()));
  turn_some(damaged, random);
  const auto repair = repaired_surface(damaged);
  EXPECT_NEAR(repair.volume_m3 / pocketed_rib_volume(), 1.0, 1e-12);
  const auto meshed = mesh_closed_surface(repair.surface);
  // All faces are planar: the remeshed surface is the same one.
  EXPECT_NEAR(volume(meshed.mesh) / pocketed_rib_volume(), 1.0, 1e-9);
}

}  // namespace
}  // namespace thinwall::mesh::surface_repair_test

#include "mesh/surface/matched_walls.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "mesh/box.hpp"
#include "mesh/surface/closed_surface.hpp"
#include "mesh/surface/wall_thickness.hpp"
#include "mesh/volume/surface_to_volume.hpp"

namespace thinwall::mesh::matched_walls_test {
namespace {

/// A fin of 1 mm and 30 mm height that is flush with one side of a base of 8 mm, both 100 mm long along y: the side of
/// the fin's wall beyond the base is larger than the other one, and its border does not follow the fin's foot.
TriangleSurface fin_on_a_base() {
  const double t = 1e-3, w = 20e-3, b = 8e-3, h = 38e-3, length = 0.1;
  const std::array<Eigen::Vector2d, 6> outline{{{0, 0}, {w, 0}, {w, b}, {t, b}, {t, h}, {0, h}}};  // x, z
  FacetedSurface result;
  for (const double y : {length, 0.0})
    for (const auto& p : outline) result.vertices.emplace_back(p.x(), y, p.y());
  for (int k = 0; k < 6; ++k) {
    const int next = (k + 1) % 6;
    result.facets.push_back({k, next, next + 6, k + 6});
  }
  // Seen from y < 0 the corners run counter-clockwise; diagonals divide the ends.
  for (const std::array<int, 3>& corners : {std::array{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {3, 4, 5}}) {
    result.facets.push_back({corners[2], corners[1], corners[0]});
    result.facets.push_back({corners[0] + 6, corners[1] + 6, corners[2] + 6});
  }
  return triangulated(result);
}

Remeshed remeshed(const TriangleSurface& surface) {
  const SurfaceSize size{.size_m = 0.03, .layers = 0, .turn_rad = 0.5};
  const SurfaceFeatures features = surface_features(surface, size.sharp_angle_rad);
  return remesh(surface, features, SizeSpace(surface, features, wall_thickness(surface, TriangleTree(surface)), size));
}

using Corners = std::set<std::array<long, 2>>;

/// The corners (y, z) of the triangles in a plane of constant x and above the base, in micrometres.
std::set<Corners> triangles_at(const TriangleSurface& surface, double x) {
  std::set<Corners> result;
  for (const auto& triangle : surface.triangles) {
    Corners corners;
    bool in_plane = true, above = true;
    for (const int v : triangle) {
      const Eigen::Vector3d& p = surface.vertices[static_cast<std::size_t>(v)];
      in_plane = in_plane && std::abs(p.x() - x) < 1e-9;
      above = above && p.z() > 8e-3 - 1e-9;
      corners.insert({std::lround(1e6 * p.y()), std::lround(1e6 * p.z())});
    }
    if (in_plane && above) result.insert(corners);
  }
  return result;
}

TEST(MatchedWalls, BothSidesOfAWallHaveTheSameTriangles) {
  const TriangleSurface surface = fin_on_a_base();
  const TriangleSurface matched = matched_walls(remeshed(surface)).surface;
  const auto outer = triangles_at(matched, 0.0), inner = triangles_at(matched, 1e-3);
  EXPECT_GT(inner.size(), 5U);
  EXPECT_EQ(outer, inner);
}

TEST(MatchedWalls, TheSurfaceStaysClosedAndKeepsItsVolume) {
  const TriangleSurface surface = fin_on_a_base();
  const TriangleSurface matched = matched_walls(remeshed(surface)).surface;
  EXPECT_NO_THROW(require_closed(matched));
  EXPECT_NEAR(volume(matched) / volume(surface), 1.0, 1e-12);
  EXPECT_TRUE(self_intersections(matched).empty());
}

TEST(MatchedWalls, ThickBodiesAreLeftAsTheyAre) {
  const Remeshed before = remeshed(triangulated(surface(Box{{0.05, 0.06, 0.07}})));
  const Remeshed after = matched_walls(before);
  EXPECT_EQ(after.surface.triangles.size(), before.surface.triangles.size());
  EXPECT_EQ(after.surface.vertices.size(), before.surface.vertices.size());
}

TEST(MatchedWalls, ElementsOfTheWallMeetInFacesAcrossIt) {
  SurfaceMeshOptions options;
  options.size = {.size_m = 0.03, .layers = 0, .turn_rad = 0.5};
  const TetMesh mesh = mesh_closed_surface(fin_on_a_base(), options).mesh;
  int prisms = 0;
  for (const auto& tet : mesh.tets) {
    std::set<std::array<long, 2>> places;  // of a third of a prism, two of the four corners lie opposite each other
    bool in_fin = true;
    for (const int v : tet) {
      const Eigen::Vector3d& p = mesh.vertices[static_cast<std::size_t>(v)];
      in_fin = in_fin && p.x() < 1e-3 + 1e-9 && p.z() > 8e-3 - 1e-9;
      places.insert({std::lround(1e6 * p.y()), std::lround(1e6 * p.z())});
    }
    if (!in_fin) continue;
    EXPECT_EQ(places.size(), 3U);
    ++prisms;
  }
  EXPECT_GE(prisms, 15);
}

/// A plate of 300 × 200 mm that is 2.985 mm thick at one end and 3.015 mm at the other, a metre from the origin.
TEST(MatchedWalls, OfSidesThatLeanALittleKeepTheirPlanesFarFromTheOrigin) {
  const Eigen::Vector3d far(1.0, -2.0, 5.0);
  FacetedSurface plate;
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.3, 0.0}, {0.3, 0.2}, {0.0, 0.2}})
      plate.vertices.push_back(far + Eigen::Vector3d(x, y, z * (2.985e-3 + 1e-4 * x)));
  plate.facets = {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  const TriangleSurface surface = triangulated(plate);
  const Remeshed matched = matched_walls(remeshed(surface));
  double off = 0.0;
  int inside = 0;
  for (const Eigen::Vector3d& vertex : matched.surface.vertices) {
    const Eigen::Vector3d v = vertex - far;
    if (v.x() < 1e-6 || v.x() > 0.3 - 1e-6 || v.y() < 1e-6 || v.y() > 0.2 - 1e-6) continue;
    off = std::max(off, std::min(std::abs(v.z()), std::abs(v.z() - 2.985e-3 - 1e-4 * v.x())));
    ++inside;
  }
  EXPECT_GT(inside, 10);
  EXPECT_LT(off, 1e-9);
  EXPECT_NEAR(volume(matched.surface) / volume(surface), 1.0, 1e-9);
}

}  // namespace
}  // namespace thinwall::mesh::matched_walls_test

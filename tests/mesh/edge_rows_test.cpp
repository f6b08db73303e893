#include "mesh/volume/edge_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "mesh/solid/edge_division.hpp"
#include "mesh/solid/quality.hpp"
#include "mesh/surface/closed_surface.hpp"
#include "mesh/surface/shapes.hpp"
#include "mesh/surface/surface_distance.hpp"
#include "mesh/volume/surface_to_volume.hpp"
#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::mesh::edge_rows_test {
namespace {

constexpr double sharp_rad = std::numbers::pi / 6.0;

/// A division leaves the same body, closed, of positive tetrahedra, and the vertices before it.
void expect_same_body(const TetMesh& divided, const TetMesh& whole) {
  EXPECT_NEAR(volume(divided) / volume(whole), 1.0, 1e-12);
  for (int t = 0; t < static_cast<int>(divided.tets.size()); ++t) EXPECT_GT(volume(divided, t), 0.0) << t;
  const TriangleSurface skin = boundary_surface(divided);
  EXPECT_NO_THROW(require_closed(skin)) << "neighbours are divided alike";
  EXPECT_LT(surface_distance(skin, boundary_surface(whole), 1e-2), 1e-12);
  ASSERT_GE(divided.vertices.size(), whole.vertices.size());
  EXPECT_TRUE(std::equal(whole.vertices.begin(), whole.vertices.end(), divided.vertices.begin()));
}

TEST(EdgeDivision, ADividedEdgeBisectsTheTetrahedraAboutIt) {
  const TetMesh whole = kuhn_box({1.0, 1.0, 1.0}, {1, 1, 1});
  const TetMesh divided =
      divided_at(whole, {{{0, 7}, whole.vertices[0] + 0.3 * (whole.vertices[7] - whole.vertices[0])}});
  EXPECT_EQ(divided.tets.size(), 2 * whole.tets.size()) << "all six have the diagonal";
  expect_same_body(divided, whole);
}

// A plate of 8 × 8 cells, each ten walls wide: vertices at the rim, on either face, and within.
TEST(EdgeRows, BesideTheRimOfAPlateAreSixTenthsOfAWallWide) {
  const double wall = 0.002, side = 80.0 * wall;
  const TetMesh whole = kuhn_box({side, side, wall}, {8, 8, 1});
  const TetMesh divided = with_rows_at_edges(whole, sharp_rad).mesh;
  expect_same_body(divided, whole);
  const double row = width_of_rows * wall;
  for (std::size_t v = whole.vertices.size(); v < divided.vertices.size(); ++v) {
    const Eigen::Vector3d& x = divided.vertices[v];
    std::array<double, 4> from_rims{x.x(), side - x.x(), x.y(), side - x.y()};
    std::ranges::sort(from_rims);
    const double across = from_rims[from_rims[0] < 1e-9 ? 1 : 0];  // a rim is divided, too, where the next one ends
    // An inclined edge leads across the wall, too: off by the square of its inclination, 1/10.
    EXPECT_NEAR(across, row, 0.01 * row) << x.transpose();
  }
  // Away from the corners nothing leads from the rim into the plate without a vertex at the row's width.
  for (const auto& tet : divided.tets) {
    for (const int a : tet) {
      const Eigen::Vector3d& x = divided.vertices[static_cast<std::size_t>(a)];
      if (x.x() > 1e-9 || std::abs(x.y() - 0.5 * side) > 0.3 * side) continue;
      for (const int b : tet) EXPECT_LT(divided.vertices[static_cast<std::size_t>(b)].x(), 1.01 * row);
    }
  }
}

TEST(EdgeRows, ABodyThatIsNowhereThinStaysAsItIs) {
  const TetMesh whole = kuhn_box({0.03, 0.02, 0.02}, {3, 2, 2});
  EXPECT_EQ(with_rows_at_edges(whole, sharp_rad).mesh.tets, whole.tets);
}

TEST(EdgeRows, InACornerOfWallsStandOnBothSidesAtTheReentrantEdges) {
  const LPocket pocket;
  const TriangleSurface surface_of_pocket = surface(pocket, 0.004);
  SurfaceMeshOptions options;
  options.size.layers = 0;
  const TetMesh whole = mesh_closed_surface(surface_of_pocket, options).mesh;
  const TetMesh divided = with_rows_at_edges(whole, sharp_rad).mesh;
  EXPECT_GT(divided.tets.size(), whole.tets.size());
  expect_same_body(divided, whole);
  EXPECT_GT(smallest_shape(divided), 1e-7) << "the bound of mesh_closed_surface()";
  // Beside the foot of the wall x ≤ wall, away from the corner, vertices lie at the row's width on the floor.
  const double wall = std::min(pocket.wall_m, pocket.floor_m), row = width_of_rows * wall;
  int found = 0;
  for (std::size_t v = whole.vertices.size(); v < divided.vertices.size(); ++v) {
    const Eigen::Vector3d& x = divided.vertices[v];
    const bool is_on_floor = std::abs(x.z() - pocket.floor_m) < 1e-9 && x.y() > 4.0 * pocket.wall_m;
    if (is_on_floor && std::abs(x.x() - pocket.wall_m - row) < 0.02 * row) ++found;
  }
  EXPECT_GE(found, 3);
}

}  // namespace
}  // namespace thinwall::mesh::edge_rows_test

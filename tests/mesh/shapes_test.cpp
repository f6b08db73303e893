#include "mesh/surface/shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "mesh/box.hpp"
#include "mesh/surface/closed_surface.hpp"

namespace thinwall::mesh::shapes_test {
namespace {

TEST(Shapes, ABlockEnclosesItsVolumeHoweverItIsTriangulated) {
  for (const double edge : {1.0, 0.03, 0.007}) {
    const TriangleSurface block = block_surface({0.15, 0.1, 0.003}, edge);
    EXPECT_NO_THROW(require_closed(block));
    EXPECT_NEAR(volume(block), 0.15 * 0.1 * 0.003, 1e-18);
  }
}

TEST(Shapes, ACylinderSectorIsTheRegularPolygonsPrism) {
  const CylinderSector sector{0.1, 0.003, 1.2, 0.05};
  for (const double edge : {0.02, 0.005}) {
    const TriangleSurface s = surface(sector, edge);
    EXPECT_NO_THROW(require_closed(s));
    const double step = sector.angle_rad / std::lround(sector.angle_rad * 0.103 / edge);
    EXPECT_NEAR(volume(s) / volume(sector), std::sin(step) / step, 1e-12);
  }
  EXPECT_NEAR(volume(sector), 0.6 * (0.103 * 0.103 - 0.01) * 0.05, 1e-18) << "angle/2 (r_o² − r_i²) h";
}

TEST(Shapes, ABladesVolumeConvergesWithTheSquareOfTheTrianglesSize) {
  const Blade blade{0.06, 0.12, 0.006, 0.003, 0.5};
  const auto error = [&](double edge) {
    const TriangleSurface s = surface(blade, edge);
    EXPECT_NO_THROW(require_closed(s));
    return std::abs(volume(s) / volume(blade) - 1.0);
  };
  const double coarse = error(0.012);
  const double fine = error(0.006);
  EXPECT_LT(coarse, 0.01);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.2);
}

TEST(Shapes, AnLPocketEnclosesFloorAndWalls) {
  const LPocket pocket;
  for (const double edge : {0.05, 0.008, 0.002}) {
    const TriangleSurface s = surface(pocket, edge);
    EXPECT_NO_THROW(require_closed(s));
    EXPECT_NEAR(volume(s) / volume(pocket), 1.0, 1e-12);
  }
  // Floor, then the two walls above it, their common corner once.
  const double above = 0.05 - 0.004;
  EXPECT_NEAR(volume(pocket), 0.12 * 0.1 * 0.004 + above * 0.003 * (0.12 + 0.1 - 0.003), 1e-15);
}

TEST(FacetedSurface, TrianglesOfABoxKeepItsCornersAndItsVolume) {
  const FacetedSurface box = surface(Box{{0.3, 0.2, 0.1}});
  const TriangleSurface triangles = triangulated(box);
  EXPECT_EQ(triangles.vertices.size(), 8U);
  EXPECT_EQ(triangles.triangles.size(), 12U);
  EXPECT_NEAR(volume(triangles), 0.006, 1e-17);
  EXPECT_NEAR(volume(faceted(triangles)), volume(box), 1e-17);
  Eigen::Vector3d closed = Eigen::Vector3d::Zero();
  for (int t = 0; t < 12; ++t) closed += area_vector(triangles, t);
  EXPECT_LT(closed.norm(), 1e-16);
}

TEST(FacetedSurface, AFacetThatIsNoPolygonIsAnError) {
  FacetedSurface box = surface(Box{{0.3, 0.2, 0.1}});
  box.facets[2].resize(2);
  EXPECT_THROW((void)triangulated(box), core::InputError);
  box = surface(Box{{0.3, 0.2, 0.1}});
  box.facets[2][0] = 8;
  EXPECT_THROW((void)triangulated(box), core::InputError);
}

}  // namespace
}  // namespace thinwall::mesh::shapes_test

// Bodies that touch or overlap become one, with the volume of their union.

#include "mesh/surface/solid_union.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.hpp"
#include "mesh/surface/separate_bodies.hpp"
#include "mesh/surface/surface_repair.hpp"
#include "solid_shapes.hpp"

namespace thinwall::mesh::solid_union_test {
namespace {

TriangleSurface block(const Eigen::Vector3d& size, double edge) {
  return block_surface(size, edge);
}

/// Both soups in one.
TriangleSoup together(TriangleSoup a, const TriangleSoup& b) {
  const int offset = static_cast<int>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (const auto& t : b.triangles) a.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  return a;
}

TriangleSoup moved(const TriangleSurface& surface, const Eigen::Vector3d& by) {
  TriangleSoup result = soup(surface);
  for (auto& x : result.points) x += by;
  return result;
}

void expect_united(const TriangleSoup& soup, int bodies, double volume_m3, double tolerance = 1e-12) {
  const SurfaceRepair repair = repaired_surface(soup);
  EXPECT_NEAR(repair.volume_m3, volume_m3, tolerance * volume_m3);
  EXPECT_NE(text(repair).find(std::to_string(bodies) + " bodies that touch or overlap and are treated as one"),
            std::string::npos)
      << text(repair);
}

TEST(SolidUnion, OfBlocksWithACommonFaceInOtherTrianglesIsTheLongerBlock) {
  const Eigen::Vector3d size(0.06, 0.04, 0.03);
  const TriangleSoup both = mesh::together(block(size, 0.02), block(size, 0.01), {0.06, 0.0, 0.0});
  expect_united(both, 2, 2.0 * size.prod());
  const TriangleSurface united = repaired_surface(both).surface;
  EXPECT_NEAR(diagonal(united), Eigen::Vector3d(0.12, 0.04, 0.03).norm(), 1e-15);
}

TEST(SolidUnion, OfBlocksWhoseFacesCoverEachOtherInPartHasBothVolumes) {
  expect_united(mesh::together(block({0.06, 0.04, 0.03}, 0.02), block({0.05, 0.05, 0.02}, 0.05), {0.01, 0.02, 0.03}), 2,
                0.06 * 0.04 * 0.03 + 0.05 * 0.05 * 0.02);
}

TEST(SolidUnion, OfOverlappingCubesCountsTheCommonVolumeOnce) {
  const TriangleSurface cube = block({0.1, 0.1, 0.1}, 0.1);
  expect_united(mesh::together(cube, cube, {0.04, 0.03, 0.02}), 2, 2e-3 - 0.06 * 0.07 * 0.08);
}

TEST(SolidUnion, OfPlatesThatOverlapAlongACommonEdgeIsTheirBracket) {
  const TriangleSurface plate = block({0.1, 0.05, 0.005}, 1.0), wall = block({0.005, 0.05, 0.06}, 1.0);
  expect_united(mesh::together(plate, wall, {0.0, 0.0, 0.0}), 2, 0.05 * (0.1 * 0.005 + 0.005 * 0.055));
}

TEST(SolidUnion, OfAPocketAndTheBlockThatFillsItIsTheWholeBlock) {
  const LPocket pocket;
  const Eigen::Vector3d open(pocket.length_m - pocket.wall_m, pocket.width_m - pocket.wall_m,
                             pocket.height_m - pocket.floor_m);
  expect_united(
      mesh::together(surface(pocket, 0.02), block(open, 0.05), {pocket.wall_m, pocket.wall_m, pocket.floor_m}), 2,
      pocket.length_m * pocket.width_m * pocket.height_m);
}

TEST(SolidUnion, OfFourBlocksAroundAnEdgeIsOneBody) {
  const TriangleSurface cube = block({0.1, 0.1, 0.1}, 0.1);
  TriangleSoup all = soup(cube);
  for (const Eigen::Vector3d& by :
       {Eigen::Vector3d(0.1, 0.1, 0.0), Eigen::Vector3d(0.1, 0.0, 0.0), Eigen::Vector3d(0.0, 0.1, 0.0)})
    all = together(all, moved(cube, by));
  expect_united(all, 4, 4e-3);
}

TEST(SolidUnion, IsNotMadeOfBodiesThatLieApartOrShareAnEdgeOnly) {
  const TriangleSurface cube = block({0.1, 0.1, 0.1}, 0.1);
  for (const Eigen::Vector3d& by : {Eigen::Vector3d(0.3, 0.0, 0.0), Eigen::Vector3d(0.1, 0.1, 0.0)}) {
    const std::vector<TriangleSoup> bodies{soup(cube), moved(cube, by)};
    const SolidUnion none = united(bodies, {});
    EXPECT_FALSE(none.surface) << by.transpose();
    EXPECT_EQ(none.failure, "") << by.transpose();
  }
}

/// Layers of bars that cross those of the layers above and below.
TriangleSoup lattice(int layers, int bars) {
  TriangleSoup all;
  for (int layer = 0; layer < layers; ++layer) {
    for (int bar = 0; bar < bars; ++bar) {
      const double across = 0.01 + 0.02 * bar, height = 0.004 * layer, length = 0.02 * bars;
      const bool along_x = layer % 2 == 0;
      const Eigen::Vector3d size =
          along_x ? Eigen::Vector3d(length, 0.005, 0.005) : Eigen::Vector3d(0.005, length, 0.005);
      const Eigen::Vector3d by = along_x ? Eigen::Vector3d(0.0, across, height) : Eigen::Vector3d(across, 0.0, height);
      all = together(all, moved(block(size, 1.0), by));
    }
  }
  return all;
}

TEST(SolidUnion, OfALatticeOfBarsCountsItsCrossingsOnce) {
  const int layers = 6, bars = 5;
  const double of_bars = layers * bars * 0.1 * 0.005 * 0.005;
  const double of_crossings = (layers - 1) * bars * bars * 0.005 * 0.005 * 0.001;
  expect_united(lattice(layers, bars), layers * bars, of_bars - of_crossings);
}

TEST(SolidUnion, ThatTakesTooLongIsNamedInTheRefusal) {
  const TriangleSurface cube = block({0.1, 0.1, 0.1}, 0.1);
  SurfaceRepairOptions options;
  options.longest_union_s = 0.0;
  try {
    (void)repaired_surface(mesh::together(cube, cube, {0.04, 0.03, 0.02}), options);
    ADD_FAILURE() << "the cubes were accepted";
  } catch (const core::InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("2 bodies whose union could not be had: it did not finish within 0 s"), std::string::npos)
        << text;
    EXPECT_NE(text.find("join them before the export"), std::string::npos) << text;
    EXPECT_NE(text.find("triangles that cross"), std::string::npos) << text;
  }
}

TEST(SeparateBodies, AreToldApartAtTheirCommonEdges) {
  const TriangleSurface cube = block({0.1, 0.1, 0.1}, 0.1);
  for (const Eigen::Vector3d& by : {Eigen::Vector3d(0.1, 0.0, 0.0), Eigen::Vector3d(0.1, 0.1, 0.0)}) {
    const TriangleSoup both = merged_points(mesh::together(cube, cube, by)).soup;
    const auto bodies = separate_bodies(both);
    ASSERT_EQ(bodies.size(), 2U);
    for (const TriangleSoup& body : bodies) {
      EXPECT_EQ(body.points.size(), 8U);
      EXPECT_NEAR(volume(TriangleSurface{body.points, body.triangles}), 1e-3, 1e-15);
    }
  }
  TriangleSoup open = soup(cube);
  open.triangles.pop_back();
  EXPECT_TRUE(separate_bodies(open).empty());
}

}  // namespace
}  // namespace thinwall::mesh::solid_union_test

#include "mesh/solid/quality.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace thinwall::mesh::quality_test {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

TEST(Quality, RegularTetrahedron) {
  const TetMesh mesh{{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 2, 1, 3}}};
  ASSERT_GT(volume(mesh, 0), 0.0);
  EXPECT_NEAR(smallest_dihedral_deg(mesh, 0), std::acos(1.0 / 3.0) / degree, 1e-12);
  EXPECT_NEAR(aspect_ratio(mesh, 0), std::sqrt(1.5), 1e-14);
  EXPECT_NEAR(smallest_height(mesh, 0), std::sqrt(8.0) * std::sqrt(2.0 / 3.0), 1e-14);
}

TEST(Quality, WorstIsFoundAndFlatnessKeepsItsDigits) {
  // A right corner with legs 1, 1, h: the angle at the large face tends to √2 h; height h, longest edge √2.
  const double h = 1e-7;
  const TetMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, h}}, {{0, 1, 2, 3}, {0, 1, 2, 4}}};
  const Quality worst = quality(mesh);
  EXPECT_EQ(worst.aspect_ratio_tet, 1);
  EXPECT_EQ(worst.smallest_dihedral_tet, 1);
  EXPECT_NEAR(worst.aspect_ratio * h, std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(worst.smallest_dihedral_deg * degree / h, std::sqrt(2.0), 1e-9);
}

TEST(Quality, ElementInsideOutHasNoFiniteRatio) {
  const TetMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1, 3}}};
  EXPECT_TRUE(std::isinf(quality(mesh).aspect_ratio));
}

}  // namespace
}  // namespace thinwall::mesh::quality_test

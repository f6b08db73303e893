#include "mesh/selection.hpp"

#include <gtest/gtest.h>

#include <string>

#include "core/error.hpp"
#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::mesh::selection_test {
namespace {

const Box box{{0.3, 0.2, 0.1}};

std::string message(const Region& region) {
  const TetMesh mesh = kuhn_box(box.size, {3, 2, 2});
  try {
    (void)select(mesh, boundary(mesh), region, "foot");
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Selection, EveryNamedFaceHoldsItsTrianglesAndItsNodesOfAnyOrder) {
  const std::array<int, 3> cells{3, 2, 4};
  const TetMesh mesh = kuhn_box(box.size, cells);
  for (std::size_t face = 0; face < 6; ++face) {
    const auto triangles = select(mesh, boundary(mesh), face_of(box, face_names()[face]), "face");
    const int m = cells[(face / 2 + 1) % 3];
    const int n = cells[(face / 2 + 2) % 3];
    EXPECT_EQ(static_cast<int>(triangles.size()), 2 * m * n);
    for (int p = 1; p <= 6; ++p) {
      const LagrangeNodes nodes = lagrange_nodes(mesh, p);
      const auto chosen = nodes_on(nodes, mesh, triangles);
      EXPECT_EQ(static_cast<int>(chosen.size()), (m * p + 1) * (n * p + 1)) << face_names()[face] << ", order " << p;
      const double where = face % 2 == 0 ? 0.0 : box.size(static_cast<Eigen::Index>(face / 2));
      for (const int node : chosen)
        EXPECT_NEAR(nodes.positions(node, static_cast<Eigen::Index>(face / 2)), where, 1e-15);
    }
  }
}

TEST(Selection, ABlockAndABallHoldTheFacesThatLieInsideWholly) {
  const TetMesh mesh = kuhn_box(box.size, {3, 2, 2});
  // One cell's corner of the face z_max, and nothing that only touches it.
  EXPECT_EQ(select(mesh, boundary(mesh), BoxRegion{{0.1, 0.0, 0.1}, {0.2, 0.1, 0.1}}, "pad").size(), 2U);
  // A ball about the corner that just holds the diagonals of 0.1 × 0.1 m: one cell of z_min, two each of x_min and
  // y_min.
  EXPECT_EQ(select(mesh, boundary(mesh), SphereRegion{{0, 0, 0}, 0.1415}, "corner").size(), 10U);
}

TEST(Selection, NothingIsAnErrorThatSaysHowFarTheNearestFaceIs) {
  const std::string text = message(PlaneRegion{{0.35, 0, 0}, {1, 0, 0}});
  EXPECT_NE(text.find("\"foot\" holds no face"), std::string::npos) << text;
  EXPECT_NE(text.find("50 mm outside"), std::string::npos) << text;
  EXPECT_NE(text.find("(300, 200, 100) mm"), std::string::npos) << "the part's extent: " << text;
  EXPECT_NE(message(SphereRegion{{0.15, 0.1, 0.05}, 0.01}).find("holds no face"), std::string::npos)
      << "inside the part";
}

TEST(Selection, EverythingIsAnError) {
  EXPECT_NE(message(BoxRegion{{-1, -1, -1}, {1, 1, 1}}).find("holds every face"), std::string::npos);
}

TEST(Selection, AnUnknownFaceIsNamedWithTheNearest) {
  try {
    (void)face_of(box, "ymin");
    FAIL() << "ymin is no face";
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean \"y_min\""), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace thinwall::mesh::selection_test

#include "mesh/solid/locate.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::mesh::locate_test {
namespace {

const Eigen::Vector3d size(0.3, 0.2, 0.1);

Eigen::Vector3d position(const TetMesh& mesh, const Location& location) {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  const auto& tet = mesh.tets[static_cast<std::size_t>(location.tet)];
  for (std::size_t k = 0; k < 4; ++k) {
    x += location.lambda(static_cast<Eigen::Index>(k)) * mesh.vertices[static_cast<std::size_t>(tet[k])];
  }
  return x;
}

TEST(Locate, FindsTheTetAndTheCoordinatesOfEveryInnerPoint) {
  const TetMesh mesh = kuhn_box(size, {3, 2, 2});
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d x = size.cwiseProduct(Eigen::Vector3d(unit(random), unit(random), unit(random)));
    const Located found = locate(mesh, x);
    EXPECT_EQ(found.distance_m, 0.0);
    EXPECT_GE(found.location.lambda.minCoeff(), 0.0);
    EXPECT_LT((position(mesh, found.location) - x).norm(), 1e-15);
  }
}

TEST(Locate, SaysHowFarAPointOutsideWasMoved) {
  const TetMesh mesh = kuhn_box(size, {3, 2, 2});
  const Eigen::Vector3d x(0.31, 0.13, 0.06);
  const Located found = locate(mesh, x);
  EXPECT_GE(found.distance_m, 0.01 - 1e-12) << "no nearer than the block is";
  EXPECT_NEAR((position(mesh, found.location) - x).norm(), found.distance_m, 1e-15);
}

/// The outward normal of the face on which a disc at (x) lies.
Eigen::Vector3d normal_at(const TetMesh& mesh, const Eigen::Vector3d& x, std::vector<Eigen::Vector3d> facing) {
  return disc_face(mesh, boundary(mesh), {x, 0.02, 0.0, std::move(facing)}).normal;
}

TEST(Patch, LiesAtAnEdgeOnTheFaceThatIsMostNearlyNormalToItsDirections) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(), z = Eigen::Vector3d::UnitZ();
  // Cells of other sizes, and a point off the edge by round-off, must not change the face.
  for (const std::array<int, 3>& cells : {std::array{3, 2, 2}, std::array{1, 1, 1}, std::array{5, 3, 7}}) {
    const TetMesh mesh = kuhn_box(size, cells);
    for (const double off : {-1e-12, 0.0, 1e-12}) {
      const Eigen::Vector3d edge(0.3 + off, 0.11, 0.1 - off);
      EXPECT_LT((normal_at(mesh, edge, {z}) - z).norm(), 1e-12);
      EXPECT_LT((normal_at(mesh, edge, {-x}) - x).norm(), 1e-12) << "either sense of a direction counts";
      EXPECT_LT((normal_at(mesh, edge, {y, z}) - z).norm(), 1e-12) << "y lies in both faces: the next decides";
      EXPECT_LT((normal_at(mesh, edge, {y}) - x).norm(), 1e-12) << "x before y before z where nothing decides";
      EXPECT_LT((normal_at(mesh, edge, {(x + 1.1 * z).normalized()}) - z).norm(), 1e-12);
      const Eigen::Vector3d corner(0.3 + off, 0.2, 0.1 - off);
      EXPECT_LT((normal_at(mesh, corner, {y}) - y).norm(), 1e-12);
    }
  }
}

TEST(Patch, NamesTheFacesThatItDidNotTake) {
  const TetMesh mesh = kuhn_box(size, {3, 2, 2});
  const auto others = [&](const Eigen::Vector3d& x) { return disc_face(mesh, boundary(mesh), {x, 0.02}).others; };
  EXPECT_TRUE(others({0.15, 0.1, 0.1}).empty());
  EXPECT_TRUE(others({0.29, 0.1, 0.1}).empty()) << "within the radius of an edge, but not on it";
  ASSERT_EQ(others({0.3, 0.11, 0.1}).size(), 1U);
  EXPECT_LT((others({0.3, 0.11, 0.1})[0] - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_EQ(others({0.3, 0.2, 0.1}).size(), 2U);
}

TEST(Patch, OfNoRadiusIsThePointItself) {
  const TetMesh mesh = kuhn_box(size, {3, 2, 2});
  const Location place = locate_on(mesh, boundary(mesh), {{0.17, 0.11, 0.047}, 0.0});
  EXPECT_LT((position(mesh, place) - Eigen::Vector3d(0.17, 0.11, 0.047)).norm(), 1e-15);
}

TEST(Patch, OffThePartOrOffItsSurfaceIsAnErrorThatSaysByHowMuch) {
  const TetMesh mesh = kuhn_box(size, {3, 2, 2});
  try {
    (void)locate_on(mesh, boundary(mesh), {{0.31, 0.13, 0.06}, 0.0});
    FAIL() << "10 mm off the part";
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("10 mm"), std::string::npos) << error.what();
  }
  EXPECT_THROW((void)locate_on(mesh, boundary(mesh), {{0.301, 0.1, 0.05}, 0.0}), core::InputError);
  EXPECT_THROW((void)disc_face(mesh, boundary(mesh), {{0.301, 0.1, 0.05}, 0.01}), core::InputError);
  EXPECT_THROW((void)disc_face(mesh, boundary(mesh), {{0.15, 0.1, 0.05}, 0.01}), core::InputError) << "inside";
}

}  // namespace
}  // namespace thinwall::mesh::locate_test

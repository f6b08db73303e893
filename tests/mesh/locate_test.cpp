#include "mesh/locate.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>
#include <string>

#include "core/error.hpp"
#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::mesh {
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

struct Average {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  double weight = 0.0;
};

Average average(const TetMesh& mesh, const Eigen::Vector3d& centre, double radius) {
  Average result;
  for (const auto& sample : patch_samples(mesh, boundary(mesh), centre, radius)) {
    const Eigen::Vector3d x = position(mesh, sample.location);
    result.mean += sample.weight * x;
    result.second += sample.weight * (x - centre) * (x - centre).transpose();
    result.weight += sample.weight;
  }
  return result;
}

TEST(Patch, AveragesALinearFieldToItsValueAtTheCentre) {
  const TetMesh mesh = kuhn_box(size, {3, 2, 2});
  const Eigen::Vector3d centre(0.3, 0.11, 0.047);
  const Average patch = average(mesh, centre, 0.02);
  EXPECT_NEAR(patch.weight, 1.0, 1e-14);
  EXPECT_LT((patch.mean - centre).norm(), 1e-15);
}

TEST(Patch, AveragesAQuadraticFieldAsADiscDoes) {
  const TetMesh mesh = kuhn_box(size, {3, 2, 2});
  const double r = 0.02;
  const Average patch = average(mesh, {0.3, 0.11, 0.047}, r);
  // ∫ y² dA / A = r²/4; rings at the middle of equal areas give it exactly. No sample leaves the face's plane.
  EXPECT_NEAR(patch.second(1, 1), r * r / 4, 1e-12);
  EXPECT_NEAR(patch.second(2, 2), r * r / 4, 1e-12);
  EXPECT_NEAR(patch.second(1, 2), 0.0, 1e-12);
  EXPECT_NEAR(patch.second(0, 0), 0.0, 1e-20);
}

TEST(Patch, IsCutAtAnEdge) {
  const TetMesh mesh = kuhn_box(size, {3, 2, 2});
  const double r = 0.02;
  const Eigen::Vector3d centre(0.15, 0.1, 0.1);
  const Average top = average(mesh, {0.3, 0.1, 0.1}, r);
  // Half a disc, on one of the two faces that meet there; its centroid lies 4r/(3π) from the edge. Midpoints of 8 rings
  // and 24 sectors reach that to 2 %.
  const double inwards = (top.mean - Eigen::Vector3d(0.3, 0.1, 0.1)).norm();
  EXPECT_NEAR(top.weight, 1.0, 1e-14);
  EXPECT_NEAR(inwards, 4 * r / (3 * std::numbers::pi), 0.02 * r);
  // Nothing is cut along the edge; the samples, turned by a quarter of a sector, are not quite symmetric about the
  // normal.
  EXPECT_NEAR(top.mean.y(), 0.1, 0.005 * r);
  EXPECT_NEAR(average(mesh, centre, r).weight, 1.0, 1e-14);
}

TEST(Patch, OfNoRadiusIsThePointItself) {
  const TetMesh mesh = kuhn_box(size, {3, 2, 2});
  const auto samples = patch_samples(mesh, boundary(mesh), {0.17, 0.11, 0.047}, 0.0);
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_LT((position(mesh, samples[0].location) - Eigen::Vector3d(0.17, 0.11, 0.047)).norm(), 1e-15);
}

TEST(Patch, OffThePartOrOffItsSurfaceIsAnErrorThatSaysByHowMuch) {
  const TetMesh mesh = kuhn_box(size, {3, 2, 2});
  try {
    (void)patch_samples(mesh, boundary(mesh), {0.31, 0.13, 0.06}, 0.0);
    FAIL() << "10 mm off the part";
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("10 mm"), std::string::npos) << error.what();
  }
  EXPECT_THROW((void)patch_samples(mesh, boundary(mesh), {0.301, 0.1, 0.05}, 0.0), core::InputError);
  EXPECT_THROW((void)patch_samples(mesh, boundary(mesh), {0.301, 0.1, 0.05}, 0.01), core::InputError);
  EXPECT_THROW((void)patch_samples(mesh, boundary(mesh), {0.15, 0.1, 0.05}, 0.01), core::InputError) << "inside";
}

}  // namespace
}  // namespace thinwall::mesh

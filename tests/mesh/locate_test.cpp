#include "mesh/solid/locate.hpp"

#include <gtest/gtest.h>

#include <array>
#include <numbers>
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

struct Average {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  double weight = 0.0;
};

Average average(const TetMesh& mesh, const Eigen::Vector3d& centre, double radius) {
  Average result;
  for (const auto& sample : patch_samples(mesh, boundary(mesh), {centre, radius})) {
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
      for (const auto& sample : patch_samples(mesh, boundary(mesh), {edge, 0.02, 0.0, {z}}))
        EXPECT_NEAR(position(mesh, sample.location).z(), 0.1, 1e-12);
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
  const auto samples = patch_samples(mesh, boundary(mesh), {{0.17, 0.11, 0.047}, 0.0});
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_LT((position(mesh, samples[0].location) - Eigen::Vector3d(0.17, 0.11, 0.047)).norm(), 1e-15);
}

TEST(Patch, OffThePartOrOffItsSurfaceIsAnErrorThatSaysByHowMuch) {
  const TetMesh mesh = kuhn_box(size, {3, 2, 2});
  try {
    (void)patch_samples(mesh, boundary(mesh), {{0.31, 0.13, 0.06}, 0.0});
    FAIL() << "10 mm off the part";
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("10 mm"), std::string::npos) << error.what();
  }
  EXPECT_THROW((void)patch_samples(mesh, boundary(mesh), {{0.301, 0.1, 0.05}, 0.0}), core::InputError);
  EXPECT_THROW((void)patch_samples(mesh, boundary(mesh), {{0.301, 0.1, 0.05}, 0.01}), core::InputError);
  EXPECT_THROW((void)patch_samples(mesh, boundary(mesh), {{0.15, 0.1, 0.05}, 0.01}), core::InputError) << "inside";
}

/// A quarter of a tube of radius R between chords: its elements lie up to a sagitta off the cylinder.
TetMesh chorded_tube(double R, double wall, double height, int chords) {
  TetMesh mesh = kuhn_box({1.0, wall, height}, {chords, 1, 2});
  for (auto& v : mesh.vertices) {
    const double angle = 0.5 * std::numbers::pi * (1.0 - v.x()), r = R + v.y();
    v = {r * std::cos(angle), r * std::sin(angle), v.z()};
  }
  return mesh;
}

TEST(Patch, OnACurvedSurfaceFallsOntoTheChordsOfTheMesh) {
  const double R = 0.05, wall = 0.002, r = 0.008;
  const int chords = 16;
  const TetMesh mesh = chorded_tube(R, wall, 0.04, chords);
  const double half = 0.25 * std::numbers::pi / chords, outer = R + wall;
  const double sagitta = outer * (1.0 - std::cos(half));
  const double middle = 0.25 * std::numbers::pi + half;  // of a chord
  const Eigen::Vector3d out(std::cos(middle), std::sin(middle), 0.0);
  for (const double radius : {outer, R}) {  // the convex face, and the concave one
    const Eigen::Vector3d x = radius * out + Eigen::Vector3d(0.0, 0.0, 0.021);
    if (radius == outer) {
      EXPECT_THROW((void)patch_samples(mesh, boundary(mesh), {x, 0.0}), core::InputError) << "off the chords";
      EXPECT_THROW((void)patch_samples(mesh, boundary(mesh), {x, r}), core::InputError);
    }
    const auto one = patch_samples(mesh, boundary(mesh), {x, 0.0, 2.0 * sagitta});
    EXPECT_LE((position(mesh, one[0].location) - x).norm(), 1.0001 * sagitta);
    const auto samples = patch_samples(mesh, boundary(mesh), {x, r, 2.0 * sagitta});
    EXPECT_EQ(samples.size(), 192U) << "nothing is cut where no edge is";
    Eigen::Vector3d mean = Eigen::Vector3d::Zero(), second = Eigen::Vector3d::Zero();
    for (const auto& sample : samples) {
      const Eigen::Vector3d p = position(mesh, sample.location);
      EXPECT_NEAR(p.head<2>().norm(), radius, 1.0001 * sagitta) << "on the face of the disc, not on the other one";
      mean += sample.weight * (p - x);
      second += sample.weight * (p - x).cwiseAbs2();
    }
    EXPECT_NEAR(second.z(), r * r / 4, 1e-3 * r * r);
    EXPECT_NEAR(mean.dot(out), -r * r / 8 / radius, sagitta) << "what the cylinder falls by in the mean";
  }
}

/// At the foot of a wall a disc on the floor ends; what lies within the wall is no part of its face.
TEST(Patch, EndsAtAnInnerCorner) {
  const TetMesh whole = kuhn_box({0.2, 0.1, 0.1}, {4, 2, 2});
  TetMesh step;
  step.vertices = whole.vertices;
  for (std::size_t t = 0; t < whole.tets.size(); ++t) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const int v : whole.tets[t]) centre += 0.25 * whole.vertices[static_cast<std::size_t>(v)];
    if (centre.x() < 0.1 || centre.z() < 0.05) step.tets.push_back(whole.tets[t]);
  }
  const double r = 0.02;
  const Eigen::Vector3d centre(0.1 + 0.25 * r, 0.06, 0.05);
  for (const auto& sample : patch_samples(step, boundary(step), {centre, r}))
    EXPECT_GE(position(step, sample.location).x(), 0.1 - 1e-12);
}

}  // namespace
}  // namespace thinwall::mesh::locate_test

// Averages over discs on flat, cut, stepped and curved surfaces.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "fem/patch.hpp"
#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::fem::disc_average_test {
namespace {

const Eigen::Vector3d size(0.3, 0.2, 0.1);

mesh::TetMesh block() {
  return mesh::kuhn_box(size, {3, 2, 2});
}

PatchAverage average(const mesh::TetMesh& mesh, const Disc& disc, int order = 2) {
  return patch_average(mesh, mesh::lagrange_nodes(mesh, order), disc, "P");
}

/// ∫ r rᵀ dA / A about the centre, from J = tr(S) I − S.
Eigen::Matrix3d second_moment(const PatchAverage& patch) {
  return 0.5 * patch.spread_m2.trace() * Eigen::Matrix3d::Identity() - patch.spread_m2;
}

TEST(DiscAverage, HasTheCentreAndTheSecondMomentOfADisc) {
  const double r = 0.02;
  const Eigen::Vector3d centre(0.3, 0.11, 0.047);
  const PatchAverage patch = average(block(), {centre, r});
  EXPECT_NEAR(patch.share.sum(), 1.0, 1e-14);
  EXPECT_LT((patch.centre_m - centre).norm(), 1e-15);
  const Eigen::Matrix3d expected = Eigen::Vector3d(0.0, r * r / 4, r * r / 4).asDiagonal();
  EXPECT_LT((second_moment(patch) - expected).norm(), 1e-12 * r * r);
}

/// The average of a field of the element's degree is its integral over the disc, for elements of any size beside it.
TEST(DiscAverage, OfAPolynomialOfTheElementsOrderIsItsIntegral) {
  const double r = 0.02;
  const Eigen::Vector3d c(0.14, 0.11, 0.1);
  for (int order = 1; order <= 6; ++order) {
    for (const std::array<int, 3>& cells : {std::array{1, 1, 1}, std::array{3, 2, 2}, std::array{40, 27, 3}}) {
      if (order > 3 && cells[0] == 40) continue;
      const mesh::TetMesh mesh = mesh::kuhn_box(size, cells);
      const auto nodes = mesh::lagrange_nodes(mesh, order);
      const PatchAverage patch = patch_average(mesh, nodes, Disc{c, r}, "P");
      double sum = 0.0;
      for (std::size_t a = 0; a < patch.nodes.size(); ++a) {
        const double x = (nodes.positions(patch.nodes[a], 0) - c.x()) / r;
        sum += patch.share(static_cast<Eigen::Index>(a)) * std::pow(x, order);
      }
      // ∫ x^n dA / (π R^(n+2)) = 2 / (n + 2) · Γ((n+1)/2) / (√π Γ(n/2 + 1)) for even n
      const double exact = order % 2 == 1 ? 0.0
                                          : 2.0 / (order + 2) * std::tgamma(0.5 * (order + 1)) /
                                                (std::sqrt(std::numbers::pi) * std::tgamma(0.5 * order + 1.0));
      // The nodal values grow as (h/r)^order, and their round-off with them.
      EXPECT_NEAR(sum, exact, 1e-15 * std::pow(0.3 / cells[0] / r + 1.0, order) + 1e-12) << order << " " << cells[0];
    }
  }
}

TEST(DiscAverage, IsCutAtAnEdge) {
  const double r = 0.02;
  const Eigen::Vector3d edge(0.3, 0.1, 0.1);
  const PatchAverage half = average(block(), {edge, r});
  EXPECT_NEAR(half.share.sum(), 1.0, 1e-14);
  EXPECT_LT((half.centre_m - edge - Eigen::Vector3d(0.0, 0.0, -4 * r / (3 * std::numbers::pi))).norm(), 1e-12 * r);
}

TEST(DiscAverage, OffThePartIsAnErrorWithTheNameOfThePoint) {
  for (const double radius : {0.0, 0.01})
    EXPECT_THROW((void)average(block(), {{0.301, 0.1, 0.05}, radius}), core::InputError);
}

/// A quarter of a tube of radius R between chords: its elements lie up to a sagitta off the cylinder.
mesh::TetMesh chorded_tube(double R, double wall, double height, int chords) {
  mesh::TetMesh mesh = mesh::kuhn_box({1.0, wall, height}, {chords, 1, 2});
  for (auto& v : mesh.vertices) {
    const double angle = 0.5 * std::numbers::pi * (1.0 - v.x()), r = R + v.y();
    v = {r * std::cos(angle), r * std::sin(angle), v.z()};
  }
  return mesh;
}

TEST(DiscAverage, OnACurvedSurfaceFallsOntoTheChordsOfTheMesh) {
  const double R = 0.05, wall = 0.002, r = 0.008;
  const int chords = 16;
  const mesh::TetMesh mesh = chorded_tube(R, wall, 0.04, chords);
  const double half = 0.25 * std::numbers::pi / chords, outer = R + wall;
  const double sagitta = outer * (1.0 - std::cos(half));
  const double middle = 0.25 * std::numbers::pi + half;  // of a chord
  const Eigen::Vector3d out(std::cos(middle), std::sin(middle), 0.0);
  for (const double radius : {outer, R}) {  // the convex face, and the concave one
    const Eigen::Vector3d x = radius * out + Eigen::Vector3d(0.0, 0.0, 0.021);
    if (radius == outer) {
      EXPECT_THROW((void)average(mesh, {x, 0.0}), core::InputError) << "off the chords";
      EXPECT_THROW((void)average(mesh, {x, r}), core::InputError);
    }
    const PatchAverage one = average(mesh, {x, 0.0, 2.0 * sagitta});
    EXPECT_LE((one.centre_m - x).norm(), 1.0001 * sagitta);
    const PatchAverage patch = average(mesh, {x, r, 2.0 * sagitta});
    // The area element of a cylinder over its tangent plane, 1 + y²/2R², makes the disc wider along the curve by less
    // than (r/R)²/8 of its second moment, and leaves it as it is to the same order along the axis.
    EXPECT_NEAR(second_moment(patch)(2, 2), r * r / 4, 0.125 * (r / R) * (r / R) * r * r / 4);
    EXPECT_NEAR((patch.centre_m - x).dot(out), -r * r / 8 / radius, sagitta)
        << "what the cylinder falls by in the mean";
  }
}

/// At the foot of a wall a disc on the floor ends; what lies within the wall is no part of its face.
TEST(DiscAverage, EndsAtAnInnerCorner) {
  const mesh::TetMesh whole = mesh::kuhn_box({0.2, 0.1, 0.1}, {4, 2, 2});
  mesh::TetMesh step;
  step.vertices = whole.vertices;
  for (std::size_t t = 0; t < whole.tets.size(); ++t) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const int v : whole.tets[t]) centre += 0.25 * whole.vertices[static_cast<std::size_t>(v)];
    if (centre.x() < 0.1 || centre.z() < 0.05) step.tets.push_back(whole.tets[t]);
  }
  const double r = 0.02, from_wall = 0.25 * r;
  const PatchAverage patch = average(step, {{0.1 + from_wall, 0.06, 0.05}, r});
  // A disc cut by a chord at the distance d from its centre: A = R² acos(−d/R) + d √(R² − d²), A x̄ = ⅔ (R² − d²)^(3/2).
  const double chord = std::sqrt(r * r - from_wall * from_wall);
  const double area = r * r * std::acos(-from_wall / r) + from_wall * chord;
  EXPECT_NEAR(patch.centre_m.x(), 0.1 + from_wall + 2.0 / 3.0 * std::pow(chord, 3) / area, 1e-12);
  EXPECT_NEAR(patch.centre_m.y(), 0.06, 1e-12);
}

}  // namespace
}  // namespace thinwall::fem::disc_average_test

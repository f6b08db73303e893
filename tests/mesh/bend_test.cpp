#include "mesh/planar/bend.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "core/error.hpp"
#include "mesh/lagrange_nodes.hpp"
#include "mesh/planar/prism_mesh.hpp"
#include "tests/mesh/plane_shapes.hpp"

namespace thinwall::mesh::bend_test {
namespace {

Positions flat_nodes() {
  PrismMeshOptions options;
  options.size_m = 0.055;
  return lagrange_nodes(mesh_prism(flat_plate(), options), 4).positions;
}

TEST(Bend, FacesOfABentPlateLieOnTwoCylinders) {
  for (const double radius : {0.2, -0.2}) {
    const Bend bend{radius, 0, 2, 0.1, 0.003};
    const Positions flat = flat_nodes();
    Positions curved = flat;
    mesh::bend(bend, curved);
    for (Eigen::Index i = 0; i < flat.rows(); ++i) {
      const double r = std::hypot(curved(i, 0) - 0.1, curved(i, 2) - (0.003 - radius));
      EXPECT_NEAR(r, std::abs(radius + flat(i, 2) - 0.003), 1e-15);
      EXPECT_EQ(curved(i, 1), flat(i, 1));
    }
  }
}

TEST(Bend, WayBackIsTheInverse) {
  for (const Bend& bend : {Bend{0.2, 0, 2, 0.1, 0.003}, Bend{-0.15, 0, 2, 0.2, 0.003}, Bend{0.1, 1, 0, 0.05, 0.2},
                           Bend{1e4, 0, 2, 0.0, 0.003}, Bend{-0.5, 0, 1, 0.225, 0.05}}) {
    const Positions flat = flat_nodes();
    double worst = 0.0;
    for (Eigen::Index i = 0; i < flat.rows(); i += 7) {
      const Eigen::Vector3d x = flat.row(i).transpose();
      if (std::abs(x[bend.through] - bend.middle_m) >= 0.9 * std::abs(bend.radius_m)) continue;
      worst = std::max(worst, (unbent(bend, bent(bend, x)) - x).norm());
    }
    // s = R φ: round-off in φ comes back R times.
    EXPECT_LT(worst, 1e-14 * std::max(1.0, std::abs(bend.radius_m)));
  }
}

/// The Jacobian by central differences: the rotation, stretched along the arc by (R + w) / R.
TEST(Bend, JacobianIsTheRotationTimesTheStretchOfTheArc) {
  const double h = 1e-6;
  for (const Bend& bend : {Bend{0.2, 0, 2, 0.1, 0.003}, Bend{-0.2, 2, 1, 0.1, 0.003}, Bend{0.3, 1, 0, 0.0, 0.1}}) {
    const Eigen::Vector3d x(0.13, 0.02, 0.05);
    Eigen::Matrix3d jacobian;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(k);
      jacobian.col(k) = (bent(bend, x + step) - bent(bend, x - step)) / (2.0 * h);
    }
    Eigen::Vector3d stretch = Eigen::Vector3d::Ones();
    stretch[bend.along] = (bend.radius_m + x[bend.through] - bend.middle_m) / bend.radius_m;
    const Eigen::Matrix3d rotation = rotation_at(bend, x);
    EXPECT_LT((jacobian - rotation * stretch.asDiagonal()).norm(), 1e-9);
    EXPECT_NEAR(rotation.determinant(), 1.0, 1e-15);
    EXPECT_GT(jacobian.determinant(), 0.0);
  }
}

TEST(Bend, LargeRadiusLeavesThePlateFlat) {
  Positions nodes = flat_nodes();
  const Positions flat = nodes;
  bend({1e9, 0, 2, 0.0, 0.003}, nodes);
  // Sag s² / 2R = 1e-10, stretch s w / R = 1.4e-12.
  EXPECT_LT((nodes - flat).cwiseAbs().maxCoeff(), 1.1 * 0.45 * 0.45 / 2e9);
}

TEST(Bend, ImpossibleBendsAreRefused) {
  const auto refused = [](const Bend& bend, const std::string& what) {
    Positions nodes = flat_nodes();
    try {
      mesh::bend(bend, nodes);
      FAIL() << "accepted: " << what;
    } catch (const core::InputError& error) {
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
  };
  refused({0.003, 0, 2, 0.0, 0.003}, "must be above 3 mm");
  refused({-0.003, 1, 2, 0.0, 0.003}, "must be above 3 mm");
  refused({0.0, 0, 2, 0.0, 0.003}, "must be above 3 mm");
  refused({NAN, 0, 2, 0.0, 0.003}, "finite");
  refused({0.45 / (2.0 * std::numbers::pi) * 0.999, 0, 2, 0.0, 0.003}, "must be below 360");
  refused({0.2, 0, 0, 0.0, 0.003}, "two different");
  refused({0.2, 0, 3, 0.0, 0.003}, "two different");
  EXPECT_TRUE(violations(Bend{0.45 / (2.0 * std::numbers::pi) * 1.001, 0, 2, 0.0, 0.003}, flat_nodes()).empty());
}

}  // namespace
}  // namespace thinwall::mesh::bend_test

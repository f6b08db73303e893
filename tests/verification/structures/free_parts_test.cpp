// Free parts have exactly six modes without stiffness, whatever their shape.

#include <gtest/gtest.h>

#include <cstdio>

#include "mesh/planar/bend.hpp"
#include "mesh/surface/shapes.hpp"
#include "mesh/volume/surface_to_volume.hpp"
#include "tests/mesh/plane_shapes.hpp"
#include "tests/verification/structures/prism_part.hpp"

namespace thinwall::free_parts_test {
namespace {

void expect_six_rigid_modes(const char* name, const mesh::TetMesh& mesh, int order, const fem::Shaping& shape = {}) {
  const Solved s = solved(mesh, order, steel_part, {}, 4, shape);
  ASSERT_EQ(s.model.rigid_motions, 6) << name;
  const auto& lambda = s.modes.pairs.lambda;
  const double rigid = lambda.head(6).cwiseAbs().maxCoeff() / lambda(6);
  // The span of the six vectors is that of the rigid motions: their energy K is round-off, and M R projects fully.
  const Eigen::MatrixXd R = fem::rigid_body_motions(s.model.nodes);
  const auto Phi = s.modes.pairs.Phi.leftCols(6);
  const Eigen::MatrixXd outside = R - Phi * (Phi.transpose() * (s.model.M * R));
  double worst = 0.0;
  for (Eigen::Index k = 0; k < 6; ++k) {
    worst =
        std::max(worst, std::sqrt(outside.col(k).dot(s.model.M * outside.col(k)) / R.col(k).dot(s.model.M * R.col(k))));
  }
  std::printf("free %s: %td DOFs, order %d, |λ| of the rigid modes %.1e of the first elastic (%.1f Hz), span to %.1e\n",
              name, s.model.K.rows(), order, rigid, s.modes.frequency_hz(6), worst);
  EXPECT_LT(rigid, 1e-6) << name;
  EXPECT_GT(lambda(6), 0.0) << name;
  EXPECT_LT(worst, 1e-5) << name;
}

TEST(FreeParts, HaveSixRigidModes) {
  const mesh::TetMesh plate = graded_mesh(mesh::flat_plate(), 0.056, 1);
  expect_six_rigid_modes("plate", plate, 4);
  expect_six_rigid_modes("bent plate", plate, 4, [](mesh::LagrangeNodes& nodes) {
    mesh::bend({0.2, 0, 2, 0.1, 0.003}, nodes.positions);
  });
  expect_six_rigid_modes("L-pocket", graded_mesh(mesh::pocket_corner(), 0.03, 1), 4);
  mesh::Prism holed = mesh::flat_plate();
  holed.holes = {mesh::regular({0.2, 0.05}, 0.02, 8)};
  expect_six_rigid_modes("plate with a hole", graded_mesh(holed, 0.06, 1), 3);
}

// 400 times as wide as thick: with K's entries the Rayleigh quotients of the rigid motions are rounded at ε tr K / tr
// M, which here is beyond 1e-6 of the first elastic eigenvalue, and no sign of a part that falls apart.
TEST(FreeParts, ThinAsPaperHaveSixRigidModesToRoundOff) {
  const fem::Material metal{200e9, 0.3, 8000.0};
  const Solved s = solved(graded_mesh(plate_prism(10.0, 10.0, 0.025), 2.5, 1), 4, metal, {}, 4);
  ASSERT_EQ(s.model.rigid_motions, 6);
  const auto& lambda = s.modes.pairs.lambda;
  const double rigid = lambda.head(6).cwiseAbs().maxCoeff() / lambda(6);
  std::printf("free 10 x 10 x 0.025 m: |λ| of the rigid modes %.1e of the first elastic (%.5f Hz)\n", rigid,
              s.modes.frequency_hz(6));
  EXPECT_GT(rigid, 1e-7) << "the point of this plate";
  EXPECT_LT(rigid, 1e-4);
  // FV12's half as thick: 0.8108 Hz by thin-plate theory, which the twist's boundary layer lowers by 0.1 %.
  EXPECT_LT(s.modes.frequency_hz(6), 0.8108);
  EXPECT_GT(s.modes.frequency_hz(6), 0.8108 * 0.998);
}

TEST(FreeParts, MadeFromClosedSurfacesHaveSixRigidModes) {
  const mesh::CylinderSector sector;
  expect_six_rigid_modes("cylinder sector",
                         mesh::mesh_closed_surface(mesh::surface(sector, 0.02), mesh::SurfaceMeshOptions{}).mesh, 3);
}

}  // namespace
}  // namespace thinwall::free_parts_test

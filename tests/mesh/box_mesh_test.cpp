// A box's mesh fills the box, whichever of its sides is the thin one.

#include "mesh/planar/box_mesh.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <string>

#include "core/error.hpp"
#include "mesh/selection.hpp"

namespace thinwall::mesh::box_mesh_test {
namespace {

class BoxMesh : public ::testing::TestWithParam<Eigen::Vector3d> {};

TEST_P(BoxMesh, FillsTheBoxWithTetrahedraOfPositiveVolume) {
  const Box box{GetParam()};
  const TetMesh mesh = mesh_box(box, {.size_m = 0.02});
  for (int tet = 0; tet < static_cast<int>(mesh.tets.size()); ++tet) EXPECT_GT(volume(mesh, tet), 0.0);
  EXPECT_NEAR(volume(mesh) / volume(box), 1.0, 1e-12);
  const auto faces = boundary(mesh);
  for (const auto& name : face_names()) {
    EXPECT_FALSE(select(mesh, faces, face_of(box, name), name).empty()) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(ThinAlongEachAxis, BoxMesh,
                         ::testing::Values(Eigen::Vector3d(0.002, 0.1, 0.05), Eigen::Vector3d(0.1, 0.002, 0.05),
                                           Eigen::Vector3d(0.1, 0.05, 0.002), Eigen::Vector3d(0.02, 0.02, 0.02)));

TEST(BoxMeshes, OfSidesThatAreNoneAreRefusedByName) {
  try {
    (void)mesh_box({Eigen::Vector3d(0.1, 0.0, NAN)}, {.size_m = 0.02});
    FAIL() << "a box without thickness was meshed";
  } catch (const core::InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("side y"), std::string::npos) << message;
    EXPECT_NE(message.find("side z"), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace thinwall::mesh::box_mesh_test

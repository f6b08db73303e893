// Displacements of points from the amplitudes of their DOFs.

#include "dynamics/dof.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace thinwall::dynamics::dof_test {
namespace {

TEST(DisplacementMatrix, SumsDirectionsOfAPointsTranslationsAndNothingElse) {
  const Eigen::Vector3d slanted(0.6, 0.0, -0.8);
  const DofTable dofs{{"A", Eigen::Vector3d::UnitX()},
                      {"B", slanted},
                      {"B", Eigen::Vector3d::UnitZ(), DofKind::rotation},
                      {"mode 1", Eigen::Vector3d::Zero(), DofKind::modal},
                      {"B", Eigen::Vector3d::UnitY()},
                      {"C", Eigen::Vector3d::UnitY(), DofKind::rotation}};
  const Eigen::VectorXd q = (Eigen::VectorXd(6) << 7.0, 2.0, 5.0, 11.0, 3.0, 13.0).finished();
  const Eigen::Matrix3Xd D = displacement_matrix(dofs, "B");
  EXPECT_LT((D * q - (2.0 * slanted + 3.0 * Eigen::Vector3d::UnitY())).norm(), 1e-15);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_EQ(D.row(axis).transpose(), displacement_row(dofs, "B", Eigen::Vector3d::Unit(axis)));
  EXPECT_EQ(displacement_matrix(dofs, "C"), Eigen::MatrixXd::Zero(3, 6)) << "it turns and does not move";
  EXPECT_THROW((void)displacement_matrix(dofs, "D"), core::InputError);
}

}  // namespace
}  // namespace thinwall::dynamics::dof_test

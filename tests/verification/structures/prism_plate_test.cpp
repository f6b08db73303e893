// The 450 × 100 × 6 mm steel plate by graded meshes of flat tetrahedra of high order, against converged
// three-dimensional Ritz solutions (error ≤ 1e-4), the closed form of the simply supported plate, and itself.

#include <gtest/gtest.h>

#include <cstdio>

#include "tests/verification/structures/prism_part.hpp"

namespace thinwall::prism_plate_test {
namespace {

const mesh::Prism plate = plate_prism(0.45, 0.1, 0.006);
const std::vector<fem::Support> both_ends{held_plane(0, 0.0), held_plane(0, 0.45)};

double report(const char* name, int order, const Solved& s, const Eigen::VectorXd& reference) {
  const double error = worst_error(elastic(s.modes), reference);
  std::printf("%s, order %d: %zu tets, %td DOFs, worst error %.4f %%, inverse residual %.1e\n", name, order,
              s.model.mesh.tets.size(), s.model.K.rows(), 100 * error, s.modes.pairs.inverse_residual.maxCoeff());
  EXPECT_LE(s.modes.pairs.inverse_residual.maxCoeff(), 1e-9) << name;
  EXPECT_GT((elastic(s.modes).head(reference.size()) - reference).cwiseQuotient(reference).minCoeff(), -1e-4)
      << name << ": frequencies converge from above";
  return error;
}

TEST(PrismPlate, ClampedAtBothEndsReachesTheThreeDimensionalFrequencies) {
  const Eigen::VectorXd reference = as_vector({160.73, 442.17, 475.67, 866.55, 989.0, 1431.95, 1571.11});
  const auto error = [&](double size, int layers, int order) {
    return report("CFCF", order, solved(graded_mesh(plate, size, layers), order, steel_part, both_ends, 7), reference);
  };
  EXPECT_LT(error(0.056, 1, 4), 1e-3);
  EXPECT_LT(error(0.056, 2, 5), 2e-4);
}

TEST(PrismPlate, FreeHasSixRigidModesAndTheThreeDimensionalFrequencies) {
  const Eigen::VectorXd reference = as_vector({157.80, 423.08, 436.62, 858.53, 871.38, 1367.8, 1421.2});
  const Solved s = solved(graded_mesh(plate, 0.056, 1), 5, steel_part, {}, 7);
  EXPECT_EQ(s.model.rigid_motions, 6);
  EXPECT_LT(report("free", 5, s, reference), 2e-4);
}

TEST(PrismPlate, SimplySupportedConvergesToTheClosedFormExponentially) {
  const Eigen::VectorXd exact = as_vector({1537.879, 1753.384, 2111.691, 2611.513, 3251.076, 3564.065, 4028.151});
  const std::vector<fem::Support> sides{held_plane(0, 0.0, {1, 2}), held_plane(0, 0.45, {1, 2}),
                                        held_plane(1, 0.0, {0, 2}), held_plane(1, 0.1, {0, 2})};
  double last = 1.0;
  // Smooth: no grading. The published figures have seven digits, 3e-7.
  for (int order = 3; order <= 6; ++order) {
    const double error =
        report("SSSS", order, solved(graded_mesh(plate, 0.056, 0), order, steel_part, sides, 7), exact);
    EXPECT_LT(error, std::max(last / 4.0, 1e-6)) << "order " << order;
    last = error;
  }
  EXPECT_LT(last, 1e-5);
}

// Against the finest solution of the same kind, with one more layer. Elements graded geometrically to the singular
// lines make the error fall by a factor an order, where equal ones give a power of the number of unknowns.
TEST(PrismPlate, ErrorFallsExponentiallyWithTheOrderOnAGradedMesh) {
  const mesh::Prism half = plate_prism(0.225, 0.1, 0.006);
  const std::vector<fem::Support> ends{held_plane(0, 0.0), held_plane(0, 0.225)};
  const Solved finest = solved(graded_mesh(half, 0.075, 3), 6, steel_part, ends, 7);
  const Eigen::VectorXd reference = elastic(finest.modes);
  const mesh::TetMesh mesh = graded_mesh(half, 0.075, 2);
  double last = 1.0;
  for (int order = 3; order <= 6; ++order) {
    const Solved s = solved(mesh, order, steel_part, ends, 7);
    const double error = worst_error(elastic(s.modes), reference);
    std::printf("CFCF, two layers, order %d: %td DOFs, %.2e off the finest (%td DOFs)\n", order, s.model.K.rows(),
                error, finest.model.K.rows());
    EXPECT_LT(error, last / 4.0) << "order " << order;
    last = error;
  }
}

}  // namespace
}  // namespace thinwall::prism_plate_test

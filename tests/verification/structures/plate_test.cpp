// The 450 × 100 × 6 mm steel plate as a solid, against converged three-dimensional Ritz solutions (error ≤ 1e-4).

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

#include "fem/modes.hpp"
#include "fem/supports.hpp"
#include "linalg/sparse_indefinite.hpp"
#include "mesh/volume/tetgen.hpp"

namespace thinwall::plate_test {
namespace {

const fem::Material steel{210e9, 0.3, 7850.0};
const mesh::Box plate{{0.006, 0.450, 0.100}};

mesh::TetMesh plate_mesh(double element_size) {
  mesh::TetgenOptions options;
  options.element_size_m = element_size;
  return mesh::tetrahedralise(mesh::surface(plate), options);
}

fem::Support face(const std::string& name, std::vector<int> axes = {0, 1, 2}) {
  return {name, mesh::face_of(plate, name), std::move(axes)};
}

/// Largest relative error of the first frequencies after the rigid ones; also that none lies below the reference.
double worst_error(const fem::Modes& modes, const std::vector<double>& reference) {
  double worst = 0.0;
  for (std::size_t k = 0; k < reference.size(); ++k) {
    const double f = modes.frequency_hz(static_cast<Eigen::Index>(k) + modes.rigid_motions);
    EXPECT_GT(f, reference[k] * (1.0 - 1e-4)) << "mode " << k + 1 << " converges from above";
    worst = std::max(worst, std::abs(f / reference[k] - 1.0));
  }
  return worst;
}

/// The bars that every eigen-solution has to pass, and one line of what was reached.
void expect_sound(const char* name, const fem::Model& model, const fem::Modes& modes, double error) {
  const Eigen::Index n = modes.pairs.Phi.cols();
  const Eigen::MatrixXd gram = modes.pairs.Phi.transpose() * (model.M * modes.pairs.Phi);
  const double orthogonality = (gram - Eigen::MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff();
  const double inverse_residual = modes.pairs.inverse_residual.maxCoeff();
  std::printf(
      "%s: %zu tets, %td DOFs, worst error %.4f %%, inverse residual %.1e, M-orthogonality %.1e, residual %.1e\n", name,
      model.mesh.tets.size(), model.K.rows(), error * 100, inverse_residual, orthogonality, modes.residual.maxCoeff());
  EXPECT_LE(inverse_residual, 1e-9);
  EXPECT_LE(orthogonality, 1e-9);
  EXPECT_LE(modes.residual.maxCoeff(), 1e-7);
}

constexpr fem::ModeOptions seven{.count = 7, .up_to_hz = {}};
const std::vector<double> cfcf{160.73, 442.17, 475.67, 866.55, 989.0, 1431.95, 1571.11};

fem::Model clamped_plate(double element_size, int order) {
  return fem::supported_model(plate_mesh(element_size), order, steel, {face("y_min"), face("y_max")});
}

double cfcf_error(const char* name, double element_size, int order) {
  const auto model = clamped_plate(element_size, order);
  const auto factored = fem::factorise(model);
  const auto modes = fem::modes(model, factored, seven);
  const double error = worst_error(modes, cfcf);
  expect_sound(name, model, modes, error);
  return error;
}

TEST(ClampedPlate, QuadraticTwelveMillimetresReachSevenTenthsOfAPercent) {
  EXPECT_LE(cfcf_error("CFCF 12 mm, order 2", 0.012, 2), 0.007);
}
TEST(ClampedPlate, QuadraticFourMillimetresReachATenthOfAPercent) {
  if (std::getenv("THINWALL_SLOW") == nullptr) GTEST_SKIP() << "half a minute: set THINWALL_SLOW=1";
  EXPECT_LE(cfcf_error("CFCF 4 mm, order 2", 0.004, 2), 0.001);
}
TEST(ClampedPlate, CubicTwelveMillimetresReachEightHundredthsOfAPercent) {
  EXPECT_LE(cfcf_error("CFCF 12 mm, order 3", 0.012, 3), 0.0008);
}

TEST(ClampedPlate, TheSturmCountProvesThatNoModeIsMissedAndNoticesOneThatIs) {
  const auto model = clamped_plate(0.012, 2);
  const auto factored = fem::factorise(model);
  const auto modes = fem::modes(model, factored, seven);
  const double above = modes.pairs.lambda(6) * (1 + 1e-6);
  const auto below = linalg::count_eigenvalues_below(model.K, model.M, above, model.node_of_row);
  ASSERT_EQ(below.value_or(-1), 7);
  // An inverse that is blind to the third mode hides it from the iteration; no residual tells.
  const Eigen::VectorXd hidden = modes.pairs.Phi.col(2);
  const linalg::ShiftedInverse blind{[&](const Eigen::Ref<const Eigen::MatrixXd>& B) -> Eigen::MatrixXd {
                                       const Eigen::MatrixXd X = factored.factor.solve(B);
                                       return X - hidden * (hidden.transpose() * (model.M * X));
                                     },
                                     0.0};
  const auto found = linalg::lowest_eigenpairs(model.K, model.M, blind, 6);
  ASSERT_NEAR(found.lambda(5), modes.pairs.lambda(6), 1e-8 * modes.pairs.lambda(6)) << "six of the seven";
  EXPECT_LE(found.inverse_residual.maxCoeff(), 1e-9);
  EXPECT_LT(found.lambda.size(), *below);
}

TEST(FreePlate, HasSixRigidModesAndTheThreeDimensionalFrequencies) {
  const auto model = fem::supported_model(plate_mesh(0.006), 2, steel, {});
  ASSERT_EQ(model.rigid_motions, 6);
  const auto factored = fem::factorise(model);
  const auto modes = fem::modes(model, factored, seven);
  const double rigid = std::sqrt(modes.pairs.lambda.head(6).cwiseAbs().maxCoeff() / modes.pairs.lambda(6));
  std::printf("free plate: rigid modes at %.1e of the first elastic frequency, shift %.1e of its eigenvalue\n", rigid,
              -factored.sigma / modes.pairs.lambda(6));
  EXPECT_LT(rigid, 1e-3);
  const double error = worst_error(modes, {157.80, 423.08, 436.62, 858.53, 871.38, 1367.8, 1421.2});
  EXPECT_LE(error, 0.003);
  expect_sound("free 6 mm, order 2", model, modes, error);
}

TEST(SimplySupportedPlate, ReachesTheExactFrequencies) {
  const auto model = fem::supported_model(
      plate_mesh(0.006), 2, steel,
      {face("y_min", {0, 2}), face("y_max", {0, 2}), face("z_min", {0, 1}), face("z_max", {0, 1})});
  ASSERT_EQ(model.rigid_motions, 0);
  const auto factored = fem::factorise(model);
  const auto modes = fem::modes(model, factored, seven);
  const double error = worst_error(modes, {1537.879, 1753.384, 2111.691, 2611.513, 3251.076, 3564.065, 4028.151});
  EXPECT_LE(error, 0.003);
  expect_sound("SSSS 6 mm, order 2", model, modes, error);
}

}  // namespace
}  // namespace thinwall::plate_test

// The 450 × 100 × 6 mm steel plate as a solid, against converged three-dimensional Ritz solutions (error ≤ 1e-4).

#include <gtest/gtest.h>

#include <array>

#include "fem/modes.hpp"
#include "fem/supports.hpp"
#include "mesh/tetgen.hpp"

namespace thinwall {
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

const std::vector<double> cfcf{160.73, 442.17, 475.67, 866.55, 989.0, 1431.95, 1571.11};

double cfcf_error(double element_size, int order) {
  const auto model = fem::supported_model(plate_mesh(element_size), order, steel, {face("y_min"), face("y_max")});
  const auto factored = fem::factorise(model);
  const auto modes = fem::modes(model, factored, {.count = 7, .up_to_hz = {}, .verify_count = false});
  const double error = worst_error(modes, cfcf);
  ::testing::Test::RecordProperty("relative_error", std::to_string(error));
  std::printf("CFCF %g mm order %d: %td tets, %td DOFs, worst error %.4f %%, residual %.1e, inverse residual %.1e\n",
              element_size * 1e3, order, static_cast<std::ptrdiff_t>(model.mesh.tets.size()), model.K.rows(),
              error * 100, modes.residual.maxCoeff(), modes.pairs.inverse_residual.maxCoeff());
  EXPECT_LE(modes.pairs.inverse_residual.maxCoeff(), 1e-9);
  EXPECT_LE(modes.residual.maxCoeff(), 1e-7);
  return error;
}

TEST(ClampedPlate, QuadraticTwelveMillimetresReachSevenTenthsOfAPercent) {
  EXPECT_LE(cfcf_error(0.012, 2), 0.007);
}
TEST(ClampedPlate, QuadraticFourMillimetresReachATenthOfAPercent) {
  EXPECT_LE(cfcf_error(0.004, 2), 0.001);
}
TEST(ClampedPlate, CubicTwelveMillimetresReachEightHundredthsOfAPercent) {
  EXPECT_LE(cfcf_error(0.012, 3), 0.0008);
}

TEST(FreePlate, HasSixRigidModesAndTheThreeDimensionalFrequencies) {
  const auto model = fem::supported_model(plate_mesh(0.006), 2, steel, {});
  ASSERT_EQ(model.rigid_motions, 6);
  const auto factored = fem::factorise(model);
  const auto modes = fem::modes(model, factored, {.count = 7, .up_to_hz = {}, .verify_count = false});
  const double rigid = std::sqrt(modes.pairs.lambda.head(6).cwiseAbs().maxCoeff() / modes.pairs.lambda(6));
  EXPECT_LT(rigid, 1e-3);
  const double error = worst_error(modes, {157.80, 423.08, 436.62, 858.53, 871.38, 1367.8, 1421.2});
  std::printf("free plate: rigid modes at %.1e of the first elastic frequency, worst error %.4f %%\n", rigid,
              error * 100);
  EXPECT_LE(error, 0.003);
  EXPECT_LE(modes.pairs.inverse_residual.maxCoeff(), 1e-9);
}

TEST(SimplySupportedPlate, ReachesTheExactFrequencies) {
  const auto model = fem::supported_model(
      plate_mesh(0.006), 2, steel,
      {face("y_min", {0, 2}), face("y_max", {0, 2}), face("z_min", {0, 1}), face("z_max", {0, 1})});
  ASSERT_EQ(model.rigid_motions, 0);
  const auto factored = fem::factorise(model);
  const auto modes = fem::modes(model, factored, {.count = 7, .up_to_hz = {}, .verify_count = false});
  const double error = worst_error(modes, {1537.879, 1753.384, 2111.691, 2611.513, 3251.076, 3564.065, 4028.151});
  std::printf("SSSS plate: worst error %.4f %%\n", error * 100);
  EXPECT_LE(error, 0.003);
}

}  // namespace
}  // namespace thinwall

// The clamped 450 × 100 × 6 mm steel plate meshed as any closed surface is: twelve triangles in, modes out.

#include <gtest/gtest.h>

#include <cstdio>
#include <vector>

#include "fem/modes.hpp"
#include "fem/supports.hpp"
#include "mesh/box.hpp"
#include "mesh/volume/surface_to_volume.hpp"

namespace thinwall::closed_surface_test {
namespace {

// 3-D Ritz values, error ≤ 1e-4.
const std::vector<double> cfcf{160.73, 442.17, 475.67, 866.55, 989.0, 1431.95, 1571.11};

double worst_error(const mesh::SurfaceMeshOptions& options, int order, std::size_t most_tets) {
  const mesh::Box plate{{0.006, 0.450, 0.100}};
  const auto meshed = mesh::mesh_closed_surface(mesh::surface(plate), options);
  EXPECT_EQ(meshed.mesher, "TetGen");
  const std::size_t tets = meshed.mesh.tets.size();
  EXPECT_LE(tets, most_tets);
  const auto model = fem::supported_model(
      meshed.mesh, order, {210e9, 0.3, 7850.0},
      {{"foot", mesh::face_of(plate, "y_min"), {0, 1, 2}}, {"head", mesh::face_of(plate, "y_max"), {0, 1, 2}}});
  const auto modes = fem::modes(model, fem::factorise(model), {.count = 7, .up_to_hz = {}});
  double worst = 0.0;
  for (std::size_t k = 0; k < cfcf.size(); ++k) {
    const double error = modes.frequency_hz(static_cast<Eigen::Index>(k)) / cfcf[k] - 1.0;
    EXPECT_GT(error, -1e-4) << "mode " << k + 1 << " converges from above";
    worst = std::max(worst, error);
  }
  std::printf("closed surface, order %d: %zu tets, %td DOFs, worst error %.4f %%\n", order, tets, model.K.rows(),
              100 * worst);
  EXPECT_LE(modes.pairs.inverse_residual.maxCoeff(), 1e-9);
  return worst;
}

TEST(ClosedSurface, OneFlatElementThroughTheWallReachesTheClampedPlatesModesAtOrderFour) {
  EXPECT_LE(worst_error({}, 4, 600), 0.0015);
}

TEST(ClosedSurface, MoreLayersAndAHigherOrderConverge) {
  mesh::SurfaceMeshOptions options;
  options.size.size_m = 0.056;
  EXPECT_LE(worst_error(options, 4, 600), 0.0008);
  options.size.layers = 2;
  EXPECT_LE(worst_error(options, 5, 1200), 0.0002);
}

}  // namespace
}  // namespace thinwall::closed_surface_test

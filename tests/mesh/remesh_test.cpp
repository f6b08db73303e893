#include "mesh/surface/remesh.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "mesh/surface/shapes.hpp"
#include "mesh/surface/surface_features.hpp"
#include "mesh/surface/wall_thickness.hpp"
#include "mesh/volume/surface_to_volume.hpp"

namespace thinwall::mesh::remesh_test {
namespace {

TEST(Remesh, CanBeInterrupted) {
  const TriangleSurface surface = block_surface({0.15, 0.1, 0.003}, 0.01);
  const SurfaceSize size{.size_m = 0.03, .layers = 0, .turn_rad = 0.5};
  const SurfaceFeatures features = surface_features(surface, size.sharp_angle_rad);
  const SizeSpace space(surface, features, wall_thickness(surface, TriangleTree(surface)), size);
  core::request_interrupt();
  EXPECT_THROW((void)remesh(surface, features, space), core::Interrupted);
  core::clear_interrupt();
}

}  // namespace
}  // namespace thinwall::mesh::remesh_test

#include "mesh/nearest_point.hpp"

#include <gtest/gtest.h>

#include <random>

#include "mesh/box.hpp"
#include "mesh/surface/shapes.hpp"

namespace thinwall::mesh::nearest_point_test {
namespace {

/// A box in closed form: max of the outer distances, or the least of the inner ones.
TEST(PointToSurface, OfABoxIsTheClosedForm) {
  const Eigen::Vector3d size(0.3, 0.2, 0.01);
  const TriangleSurface box = triangulated(surface(Box{size}));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-0.5, 1.5);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d x = size.cwiseProduct(Eigen::Vector3d(unit(random), unit(random), unit(random)));
    const Eigen::Vector3d beyond = (-x).cwiseMax(x - size);
    const bool inside = beyond.maxCoeff() < 0.0;
    const double distance = inside ? -beyond.maxCoeff() : beyond.cwiseMax(0.0).norm();
    const PointToSurface place = point_to_surface(box, x);
    EXPECT_EQ(place.inside, inside) << x.transpose();
    EXPECT_NEAR(place.distance_m, distance, 1e-15);
  }
}

}  // namespace
}  // namespace thinwall::mesh::nearest_point_test

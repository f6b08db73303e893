// Force and torque of an edge with the feed in its chip, against slices.

#include "milling/cut/cutting_load.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace thinwall::milling::cutting_load_test {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double feed = 0.1e-3;
const CuttingCoefficients with_edges{6e8, 2e8, 1e8, 2e4, 1.5e4, 1e3};

TEST(CuttingLoad, OfAHelicalBallIsTheSumOfThinSlices) {
  Cutter cutter{2, 0.01, {}, {25.0 * degree, 25.0 * degree}};
  cutter.envelope = ball_end(0.01);
  const double depth = 2e-3;
  MillingProcess process;
  process.cutter = cutter;
  process.coefficients = with_edges;
  process.engagement = {20.0 * degree, 150.0 * degree};
  const CutCycle cycle = cut_cycle(process, depth);
  const Sweep& sweep = cycle.sweeps.front();
  const double s = 1.0;
  const CuttingLoad load = edge_load(cutter, sweep, edge_shape(cutter, depth), depth, s, feed_advance(cutter, feed));
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  double torque = 0.0;
  constexpr int slices = 40000;
  for (int i = 0; i < slices; ++i) {
    // Midpoints in the square root of the height, in which the tip of a ball is smooth.
    const double x = (i + 0.5) / slices;
    const double z = depth * x * x;
    const double dz = 2.0 * depth * x / slices;
    const double kappa = std::acos(1.0 - z / 0.005);
    const double radius = 0.005 * std::sin(kappa);
    const double phi = 20.0 * degree + s - z * 2.0 * std::tan(25.0 * degree) / 0.01;
    const double h = feed * std::sin(phi) * std::sin(kappa) * dz / std::sin(kappa);
    const double dS = std::hypot(1.0 / std::sin(kappa), radius * 2.0 * std::tan(25.0 * degree) / 0.01) * dz;
    const double tangential = with_edges.K_t * h + with_edges.K_te * dS;
    const double normal = with_edges.K_r * h + with_edges.K_re * dS;
    const double axial = with_edges.K_a * h + with_edges.K_ae * dS;
    const Eigen::Vector3d r(std::sin(phi), std::cos(phi), 0.0);
    const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
    force += -tangential * Eigen::Vector3d(std::cos(phi), -std::sin(phi), 0.0) -
             normal * (std::sin(kappa) * r - std::cos(kappa) * up) +
             axial * (std::cos(kappa) * r + std::sin(kappa) * up);
    torque += tangential * radius;
  }
  EXPECT_LT((load.force - force).norm(), 1e-7 * force.norm());
  EXPECT_NEAR(load.torque / torque, 1.0, 1e-7);
}

}  // namespace
}  // namespace thinwall::milling::cutting_load_test

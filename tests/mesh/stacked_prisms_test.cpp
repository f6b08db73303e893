// Layers of constant cross-section: volumes in closed form, surfaces without a border.

#include "mesh/planar/stacked_prisms.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace thinwall::mesh::stacked_prisms_test {
namespace {

std::vector<Eigen::Vector2d> rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

bool is_closed(const TriangleSurface& surface) {
  std::map<std::pair<int, int>, int> once;
  for (const auto& t : surface.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++once[{t[i], t[(i + 1) % 3]}];
  }
  for (const auto& [edge, times] : once) {
    const auto back = once.find({edge.second, edge.first});
    if (times != 1 || back == once.end() || back->second != 1) return false;
  }
  return true;
}

TEST(StackedPrisms, HaveTheVolumeOfTheirLayers) {
  std::vector<Eigen::Vector2d> star;
  constexpr int corners = 20;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    star.push_back((i % 2 == 0 ? 0.02 : 0.01) * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  const double star_m2 = corners * 0.5 * 0.02 * 0.01 * std::sin(2.0 * std::numbers::pi / corners);
  const std::vector<Layer> layers{
      {0.0, 0.002, {rectangle(0.0, 0.0, 0.1, 0.05), rectangle(0.02, 0.01, 0.04, 0.03)}},  // with a hole
      {0.002, 0.003, {rectangle(0.0, 0.0, 0.01, 0.01), rectangle(0.05, 0.0, 0.06, 0.01)}},
      {0.003, 0.007, {star}},
      {0.007, 0.008, {}}};
  const TriangleSurface surface = stacked_prisms(layers);
  EXPECT_TRUE(is_closed(surface));
  EXPECT_NEAR(volume(surface), 0.002 * (0.1 * 0.05 - 0.02 * 0.02) + 0.001 * 2e-4 + 0.004 * star_m2, 1e-15);
}

}  // namespace
}  // namespace thinwall::mesh::stacked_prisms_test

#include "mesh/surface/wall_thickness.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/error.hpp"
#include "core/parallel.hpp"

namespace thinwall::mesh {

namespace {

constexpr double cone_rad = 15.0 * std::numbers::pi / 180.0;
constexpr int cone_rays = 6;

double thickness_beneath(const TriangleSurface& surface, const TriangleTree& tree, int triangle) {
  const Eigen::Vector3d from = centroid(surface, triangle);
  const Eigen::Vector3d inwards = -area_vector(surface, triangle).normalized();
  const Eigen::Vector3d across = inwards.unitOrthogonal();
  std::vector<double> found;
  const auto shoot = [&](const Eigen::Vector3d& direction) {
    if (const auto way = tree.first_hit(from, direction, triangle)) found.push_back(*way * direction.dot(inwards));
  };
  shoot(inwards);
  for (int k = 0; k < cone_rays; ++k) {
    const Eigen::AngleAxisd around(2.0 * std::numbers::pi * k / cone_rays, inwards);
    shoot(std::cos(cone_rad) * inwards + std::sin(cone_rad) * (around * across));
  }
  if (found.empty()) {
    throw core::NumericalError("no wall was found beneath triangle " + std::to_string(triangle) +
                               " of the surface; close the surface and turn its normals outwards");
  }
  const auto middle = found.begin() + static_cast<std::ptrdiff_t>(found.size() / 2);
  std::nth_element(found.begin(), middle, found.end());
  return *middle;
}

}  // namespace

std::vector<double> wall_thickness(const TriangleSurface& surface, const TriangleTree& tree) {
  constexpr std::size_t at_once = 256;
  const std::size_t count = surface.triangles.size();
  std::vector<double> result(count);
  core::parallel_for((count + at_once - 1) / at_once, [&](std::size_t block) {
    for (std::size_t t = block * at_once; t < std::min(count, (block + 1) * at_once); ++t)
      result[t] = thickness_beneath(surface, tree, static_cast<int>(t));
  });
  return result;
}

double median_thickness(const TriangleSurface& surface, const std::vector<double>& thickness,
                        std::vector<int> triangles) {
  const auto thickness_of = [&](int t) { return thickness[static_cast<std::size_t>(t)]; };
  std::sort(triangles.begin(), triangles.end(), [&](int a, int b) { return thickness_of(a) < thickness_of(b); });
  double total = 0.0;
  for (const int t : triangles) total += area_vector(surface, t).norm();
  double sum = 0.0;
  for (const int t : triangles) {
    sum += area_vector(surface, t).norm();
    if (sum >= 0.5 * total) return thickness_of(t);
  }
  throw core::InputError("there is no wall thickness of no triangles; name at least one");
}

}  // namespace thinwall::mesh

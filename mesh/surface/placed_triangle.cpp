#include "mesh/surface/placed_triangle.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace thinwall::mesh {

namespace {

/// True if x lies within the allowed deviation of the patch.
bool lies_on(const SizeSpace& space, int patch, const Eigen::Vector3d& x) {
  return space.is_planar(patch) || (space.on_patch(patch, x) - x).norm() <= space.allowed_deviation_m(patch);
}

}  // namespace

Place make_place(const SizeSpace& space, int patch, const Eigen::Vector3d& x) {
  Place place{patch, x, space.normal(patch, x), {}};
  place.wanted = space.at(patch, x, place.normal);
  return place;
}

double length(const SizeSpace& space, const Place& a, const Place& b) {
  const Eigen::VectorXd middle = space.at(a.patch, 0.5 * (a.x + b.x), 0.5 * (a.normal + b.normal));
  return (middle - a.wanted).norm() + (b.wanted - middle).norm();
}

double quality(const SizeSpace& space, const Place& a, const Place& b, const Place& c) {
  const double x = length(space, b, c);
  const double y = length(space, c, a);
  const double z = length(space, a, b);
  const double squares = (x + y + z) * (-x + y + z) * (x - y + z) * (x + y - z);
  return std::sqrt(3.0 * std::max(0.0, squares)) / (x * x + y * y + z * z);
}

bool faces_outwards(const Place& a, const Place& b, const Place& c) {
  constexpr double smallest_shape = 1e-4;    // area / (longest edge)² of a triangle that still has a direction
  constexpr double cosine_of_turn = 0.7071;  // 45°
  const Eigen::Vector3d area = 0.5 * (b.x - a.x).cross(c.x - a.x);
  const double squared = std::max({(b.x - a.x).squaredNorm(), (c.x - b.x).squaredNorm(), (a.x - c.x).squaredNorm()});
  if (!(area.norm() > smallest_shape * squared)) return false;
  return area.dot(a.normal + b.normal + c.normal) > cosine_of_turn * area.norm() * 3.0;
}

bool is_faithful(const SizeSpace& space, const Place& a, const Place& b, const Place& c) {
  return faces_outwards(a, b, c) && lies_on(space, a.patch, (a.x + b.x + c.x) / 3.0) &&
         lies_on(space, a.patch, 0.5 * (a.x + b.x)) && lies_on(space, a.patch, 0.5 * (b.x + c.x)) &&
         lies_on(space, a.patch, 0.5 * (c.x + a.x));
}

}  // namespace thinwall::mesh

#include "setup/point.hpp"

#include <cmath>

namespace thinwall::setup {

bool contains(const Selection& selection, const Eigen::Vector3d& p, double tolerance) {
  if (selection.plane) return std::abs((p - selection.plane->point).dot(selection.plane->normal)) <= tolerance;
  if (selection.box) {
    return ((p - selection.box->min).array() >= -tolerance).all() &&
           ((selection.box->max - p).array() >= -tolerance).all();
  }
  return selection.sphere && (p - selection.sphere->centre).norm() <= selection.sphere->radius + tolerance;
}

}  // namespace thinwall::setup

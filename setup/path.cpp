#include "setup/path.hpp"

#include <algorithm>

namespace thinwall::setup {

namespace {

Point moved(const Part& part, const Point& from, const Eigen::Vector3d& by) {
  Point to = from;
  to.at.reset();
  to.offset.setZero();
  to.position = position(part, from) + by;
  return to;
}

/// Both stand for the same patch; the cut, which has all directions, then serves the contact too.
bool coincide(const Part& part, const Point& a, const Point& b) {
  const double distance = (*a.position - *b.position).norm();
  return distance <= 1e-9 * box_size(part).maxCoeff() && a.patch_radius == b.patch_radius;
}

}  // namespace

Setup at_position(const Setup& source, std::size_t position_number) {
  const Part& part = *source.part;
  const Point& start = point(source, source.cutting->at);
  const Eigen::Vector3d way = source.path->positions[position_number] - position(part, start);
  Setup there = source;
  Point cut = moved(part, start, way);
  cut.position = source.path->positions[position_number];  // to the last bit
  cut.name = "the cut";                                    // no name that a user can give
  there.cutting->at = cut.name;
  there.points = {cut};
  there.reduction.interface = {cut.name};
  for (Contact& contact : there.contacts) {
    const Eigen::Vector3d by = source.path->robot_follows ? way : Eigen::Vector3d::Zero();
    const Point touched = moved(part, point(source, contact.part_point), by);
    if (coincide(part, touched, cut)) {
      contact.part_point = cut.name;
    } else if (std::ranges::count(there.reduction.interface, touched.name) == 0) {
      there.points.push_back(touched);
      there.reduction.interface.push_back(touched.name);
    }
  }
  return there;
}

}  // namespace thinwall::setup

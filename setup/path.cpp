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

PathStation station(const Setup& source, std::size_t position_number) {
  const Part& part = *source.part;
  const Point& start = point(source, source.cutting->at);
  const Eigen::Vector3d way = source.path->positions[position_number] - position(part, start);
  Point cut = moved(part, start, way);
  cut.position = source.path->positions[position_number];  // to the last bit
  cut.name = "the cut";                                    // no name that a user can give
  PathStation there{{cut}, cut.name, {}};
  for (const SupportContact& contact : source.contacts) {
    const Eigen::Vector3d by = source.path->robot_follows ? way : Eigen::Vector3d::Zero();
    const Point touched = moved(part, point(source, contact.part_point), by);
    if (coincide(part, touched, cut)) {
      there.touched.push_back(cut.name);
      continue;
    }
    there.touched.push_back(touched.name);
    if (std::ranges::find(there.points, touched.name, &Point::name) == there.points.end())
      there.points.push_back(touched);
  }
  return there;
}

std::vector<PathStation> stations(const Setup& source) {
  std::vector<PathStation> all;
  if (!source.path || !source.part) return all;
  all.reserve(source.path->positions.size());
  for (std::size_t i = 0; i < source.path->positions.size(); ++i) all.push_back(station(source, i));
  return all;
}

PartSetup part_at(const PartSetup& source, const PathStation& station) {
  PartSetup there = source;
  there.points = station.points;
  there.reduction.interface.clear();
  for (const Point& point : station.points) there.reduction.interface.push_back(point.name);
  return there;
}

SupportSetup support_at(const SupportSetup& source, const PathStation& station) {
  SupportSetup there = source;
  for (std::size_t i = 0; i < there.contacts.size(); ++i) there.contacts[i].part_point = station.touched[i];
  if (carries_tool(there.robot)) there.robot->cut_point = station.cut;
  return there;
}

CutSetup cut_at(const CutSetup& source, const PathStation& station) {
  CutSetup there = source;
  there.cutting->at = station.cut;
  return there;
}

}  // namespace thinwall::setup

#include "setup/part_attachments.hpp"

#include <algorithm>

#include "setup/part_geometry.hpp"

namespace thinwall::setup {

namespace {

bool carries(const Part& part, const Point& point) {
  return std::ranges::count(part.masses, point.name, &PointMass::at) > 0 ||
         std::ranges::count(part.springs, point.name, &PointSpring::at) > 0;
}

}  // namespace

fem::Attachments attachments_of(const PartSetup& source) {
  const Part& part = *source.part;
  fem::Attachments result;
  for (const Clamp& clamp : part.clamps)
    result.clamps.push_back({clamp.on, region_of(source, clamp.on), clamp.normal, clamp.tangential});
  for (const Point& point : source.points) {
    if (!point.rigid && !carries(part, point)) continue;
    result.points.push_back({point.name, fem::disc_of(named_point(source, point.name)),
                             point.rigid ? fem::Connection::rigid : fem::Connection::averaging});
  }
  for (const PointMass& mass : part.masses)
    result.masses.push_back({mass.at, mass.mass, mass.inertia.asDiagonal(), mass.offset});
  for (const PointSpring& spring : part.springs) {
    result.springs.push_back(
        {spring.at, spring.stiffness.asDiagonal(), spring.rotation_stiffness.asDiagonal(), spring.offset});
  }
  return result;
}

}  // namespace thinwall::setup

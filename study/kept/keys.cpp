#include "study/kept/keys.hpp"

#include <algorithm>
#include <vector>

#include "study/kept/checkpoint.hpp"

namespace thinwall::study {

namespace {

/// Whether anything of the undamped part follows from the damping.
bool damping_shapes_part(const cases::Case& source) {
  const bool from_file = source.part && source.part->shape == "matrices";
  return source.reduction.tolerance || from_file ||
         std::ranges::count(source.updating, "part", &setup::Updating::on) > 0;
}

/// The points that move along a path, from which the positions of all others follow; none without one.
std::vector<std::string> moving_points(const cases::Case& source) {
  std::vector<std::string> points;
  if (!source.path || !source.cutting) return points;
  points.push_back(source.cutting->at);
  for (const setup::Contact& contact : source.contacts) points.push_back(contact.part_point);
  return points;
}

}  // namespace

std::string part_key(const cases::Case& source) {
  std::vector<std::string> without{"title", "robot", "contacts", "coupling", "tool", "cutting", "lobes", "machine"};
  if (!damping_shapes_part(source)) without.emplace_back("damping");
  return key_of(source, without, moving_points(source));
}

std::string structure_key(const cases::Case& source) {
  return key_of(source, {"title", "tool", "cutting", "lobes", "machine"}, moving_points(source));
}

std::string charts_key(const cases::Case& source) {
  std::vector<std::string> without{"title", "machine"};
  const bool asks_for_feed = source.cutting && (source.cutting->law == "power" || source.cutting->law == "fractional");
  if (!asks_for_feed) without.emplace_back("cutting.spindle_speed");
  return key_of(source, without);
}

}  // namespace thinwall::study

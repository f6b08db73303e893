#include "setup/machining_setup.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/nearest_name.hpp"

namespace thinwall::setup {

bool names_node_set(const PartSetup& source, const std::string& name) {
  const bool face = name.size() == 5 && std::string("xyz").find(name[0]) != std::string::npos &&
                    (name.ends_with("_min") || name.ends_with("_max"));
  return source.part && kind(*source.part) == ShapeKind::mesh && !face &&
         std::ranges::find(source.selections, name, &Selection::name) == source.selections.end();
}

const Point& point(const PartSetup& source, const std::string& name) {
  const auto found = std::ranges::find(source.points, name, &Point::name);
  if (found != source.points.end()) return *found;
  std::vector<std::string> names;
  for (const auto& known : source.points) names.push_back(known.name);
  throw core::InputError("the case has no point \"" + name + "\"" + core::did_you_mean(name, names));
}

}  // namespace thinwall::setup

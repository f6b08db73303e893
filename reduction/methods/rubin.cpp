#include "reduction/methods/rubin.hpp"

namespace thinwall::reduction {

dynamics::SpatialModel rubin(const FreeInterface& part) {
  return in_interface_coordinates(part, ResidualInertia::kept);
}

}  // namespace thinwall::reduction

#include "reduction/methods/macneal.hpp"

namespace thinwall::reduction {

dynamics::SpatialModel macneal(const FreeInterface& part) {
  return in_interface_coordinates(part, ResidualInertia::neglected);
}

}  // namespace thinwall::reduction

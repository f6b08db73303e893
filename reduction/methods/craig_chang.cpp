#include "reduction/methods/craig_chang.hpp"

namespace thinwall::reduction {

dynamics::SpatialModel craig_chang(const FreeInterface& part) {
  return in_modes_and_forces(part, ResidualInertia::kept);
}

}  // namespace thinwall::reduction

#include "io/surface_unit.hpp"

#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"

namespace thinwall::io {

double metres_per_unit(const std::string& unit, const std::string& file) {
  if (unit.empty()) {
    throw core::InputError("the unit of \"" + file +
                           "\" is missing; files of its kind do not tell it, state \"mm\", \"m\" or \"inch\"");
  }
  const core::Quantity quantity = core::parse_unit(unit);
  if (quantity.dimension != core::parse_unit("m").dimension) {
    throw core::InputError("the unit of \"" + file + "\" is \"" + unit + "\", a " +
                           core::dimension_name(quantity.dimension) + "; state a length: \"mm\", \"m\" or \"inch\"");
  }
  return quantity.value;
}

void require_metres_per_unit(double metres_per_unit, const std::string& file) {
  if (std::isfinite(metres_per_unit) && metres_per_unit > 0.0) return;
  throw core::InputError("the unit of \"" + file + "\" is " + core::number_text(metres_per_unit) +
                         " m; give a positive length, 0.001 for millimetres");
}

}  // namespace thinwall::io

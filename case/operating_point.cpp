#include "case/operating_point.hpp"

#include "core/error.hpp"
#include "core/units.hpp"

namespace thinwall::cases {

milling::OperatingPoint operating_point(const std::string& text) {
  const auto comma = text.find(',');
  if (comma == std::string::npos || text.find(',', comma + 1) != std::string::npos)
    throw core::InputError("a spindle speed and a depth with one comma between them are expected");
  const milling::OperatingPoint point{core::parse_quantity(text.substr(0, comma), core::kind::spindle_speed),
                                      core::parse_quantity(text.substr(comma + 1), core::kind::length)};
  if (!(point.spindle_speed_rpm > 0.0) || !(point.depth_m > 0.0))
    throw core::InputError("speed and depth must be above 0");
  return point;
}

}  // namespace thinwall::cases

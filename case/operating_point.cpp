#include "case/operating_point.hpp"

#include "case/schema/physical_range.hpp"
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
  constexpr double slowest_rpm = 1.0, fastest_rpm = 1e6;
  if (!(point.spindle_speed_rpm >= slowest_rpm && point.spindle_speed_rpm <= fastest_rpm)) {
    const auto speed = [](double rpm) { return core::readable_text(rpm, core::kind::spindle_speed); };
    throw core::InputError(speed(point.spindle_speed_rpm) + " is no spindle speed in machining: these lie between " +
                           speed(slowest_rpm) + " and " + speed(fastest_rpm) + "; check number and unit");
  }
  require_physical(core::kind::length, point.depth_m);
  return point;
}

}  // namespace thinwall::cases

#include "report/summary/quantity_kind.hpp"

#include <algorithm>

namespace thinwall::report {

std::string_view unit_of(Kind kind) {
  switch (kind) {
    case Kind::length:
      return "m";
    case Kind::volume:
      return "m^3";
    case Kind::angle:
      return "rad";
    case Kind::angle_deg:
      return "deg";
    case Kind::mass:
      return "kg";
    case Kind::frequency:
      return "Hz";
    case Kind::spindle_speed:
      return "rpm";
    case Kind::force:
      return "N";
    case Kind::torque:
      return "N m";
    case Kind::power:
      return "W";
    case Kind::pressure:
      return "Pa";
    case Kind::stiffness:
      return "N/m";
    case Kind::damping:
      return "N s/m";
    case Kind::compliance:
      return "m/N";
    case Kind::removal_rate:
      return "cm^3/min";
    case Kind::time:
    case Kind::run_time:
      return "s";
    default:
      return "";
  }
}

bool stays_small(Kind kind) {
  return kind == Kind::residual || kind == Kind::error_estimate;
}

bool is_number(Kind kind) {
  return kind != Kind::text && kind != Kind::sentence && kind != Kind::truth && kind != Kind::section;
}

Kind kind_of_column(std::string_view name) {
  for (const char* residual : {"relative_residual", "growth_difference", "forced_difference"})
    if (name == residual) return Kind::residual;
  for (const char* estimate : {"error_estimate_relative", "multiplier_march_error", "multiplier_lobes_error"})
    if (name == estimate) return Kind::error_estimate;
  return Kind::ratio;
}

}  // namespace thinwall::report

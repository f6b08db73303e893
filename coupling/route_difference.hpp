#pragma once
// The difference between the results of the spatial and the receptance route.

#include <string>

#include "dynamics/response_model.hpp"

namespace thinwall::coupling {

/// The largest relative difference, with its frequency and entry.
struct RouteDifference {
  double max_relative = 0.0;
  double at_frequency_hz = 0.0;
  std::string entry;  ///< "xy": response along x, force along y; over several points "P.x/Q.y"
};

/// The largest |G_spatial − G_receptance| / (largest |G_spatial| of that line) over lines and entries, between the
/// translations of `response_point` and `force_point` (nine entries for a full table). Throws InputError if axes or
/// tables differ, NumericalError if a value is not finite. Cost lines · entries.
[[nodiscard]] RouteDifference route_difference(const dynamics::ResponseModel& spatial,
                                               const dynamics::ResponseModel& receptance,
                                               const std::string& response_point, const std::string& force_point);

/// The largest relative difference over every entry of both tables.
[[nodiscard]] RouteDifference route_difference(const dynamics::ResponseModel& spatial,
                                               const dynamics::ResponseModel& receptance);

}  // namespace thinwall::coupling

#pragma once
// A robot's tip from a measurement: one direct receptance along one direction, which is all that Barrios 2019, Eq.
// 12-14 needs.

#include <Eigen/Core>
#include <string>

#include "dynamics/response_model.hpp"

namespace thinwall::robot {

/// The 1 × 1 response H (m/N, one value for each frequency line) of `point` along the unit vector `direction` in the
/// part's axes (Barrios 2019, Eq. 2 and section 4: with one contact direction nothing else of the robot is needed).
/// Throws InputError if the direction is no unit vector, DataError if the values and the axis differ in length, the
/// frequencies do not rise or a value is not finite.
[[nodiscard]] dynamics::ResponseModel measured_receptance(const dynamics::FrequencyAxis& axis,
                                                          const Eigen::VectorXcd& receptance, const std::string& point,
                                                          const Eigen::Vector3d& direction);

}  // namespace thinwall::robot

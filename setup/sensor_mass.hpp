#pragma once
// The masses of accelerometers, taken off the FRFs that were measured with them.

#include <optional>
#include <string>
#include <vector>

#include "dynamics/response_model.hpp"
#include "setup/machining_setup.hpp"

namespace thinwall::setup {

/// The relative change by a sensor of the direct FRF of its point along one direction: |H − G|/|G| = ω² m |H| for one
/// direction alone, H without the sensor, G with it; and the lowest resonance that a fit of peaks finds in either
/// (reduction/identification.hpp), none where it finds none.
struct SensorEffect {
  std::string dof;
  double largest_change = 0.0;  ///< relative to |G| of the line
  double at_frequency_hz = 0.0;
  std::optional<double> resonance_with_hz, resonance_without_hz;
};

/// One a translation of `point`, by which `without` differs from `with`, both between equal tables.
[[nodiscard]] std::vector<SensorEffect> sensor_effects(const dynamics::ResponseModel& with,
                                                       const dynamics::ResponseModel& without,
                                                       const std::string& point);

/// The FRFs with the mass of every sensor taken off, one after another (coupling::remove_point_mass; masses add up, so
/// that the order does not matter), along the directions that were measured. Logs for each its effect and the
/// directions that were not measured, along which its mass stays. `whose`: "the robot's". Errors as
/// coupling::remove_point_mass. Cost lines · DOFs² a sensor.
[[nodiscard]] dynamics::ResponseModel without_sensors(dynamics::ResponseModel measured,
                                                      const std::vector<Sensor>& sensors, const std::string& whose);

}  // namespace thinwall::setup

#include "app/fit/fit_sensors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "core/units.hpp"
#include "coupling/decoupling.hpp"
#include "setup/sensor_mass.hpp"

namespace thinwall::app {

namespace {

setup::Sensor sensor_of(const std::string& word) {
  const auto at = word.rfind('=');
  if (at == std::string::npos || at == 0)
    throw core::UsageError("--sensor \"" + word + "\": write the point and its mass, as \"1=30 g\"");
  try {
    const double mass = core::parse_quantity(word.substr(at + 1), core::kind::mass);
    if (mass > 0.0) return {word.substr(0, at), mass};
  } catch (const core::InputError& error) {
    throw core::UsageError("--sensor \"" + word + "\": " + error.what());
  }
  throw core::UsageError("--sensor \"" + word + "\": the mass must be above 0");
}

coupling::CoupledResponse without(const dynamics::ResponseModel& measured, const setup::Sensor& sensor) {
  try {
    return coupling::remove_point_mass(measured, sensor.point, sensor.mass);
  } catch (const core::InputError& error) {
    throw core::UsageError("--sensor \"" + sensor.point + "\": " + error.what());
  }
}

/// "1.x by up to 4 % at 812 Hz"
std::vector<std::string> changes(const std::vector<setup::SensorEffect>& effects) {
  std::vector<std::string> words;
  words.reserve(effects.size());
  for (const setup::SensorEffect& effect : effects)
    words.push_back(effect.dof + " by up to " + core::number_text(100.0 * effect.largest_change, 3) + " % at " +
                    core::number_text(effect.at_frequency_hz, 4) + " Hz");
  return words;
}

}  // namespace

std::vector<std::string> free_of_sensors(FitMatrix& matrix, const std::vector<std::string>& words) {
  constexpr double most_condition = 10.0;
  std::vector<std::string> doubts;
  for (const std::string& word : words) {
    const setup::Sensor sensor = sensor_of(word);
    coupling::CoupledResponse freed = without(matrix.measured, sensor);
    const auto effects = setup::sensor_effects(matrix.measured, freed.response, sensor.point);
    const std::string mass = core::readable_text(sensor.mass, core::kind::mass) + " at " + sensor.point;
    Eigen::Index worst = 0;
    const double condition = freed.kernel_condition.maxCoeff(&worst);
    matrix.notes.push_back(fmt::format("{} is taken off, which changes {}", mass, fmt::join(changes(effects), ", ")));
    if (condition > most_condition)
      doubts.push_back(
          fmt::format("without {} errors of the line at {} Hz grow {} times; measure with a lighter sensor", mass,
                      core::number_text(matrix.measured.axis.hz(worst), 4), core::number_text(condition, 2)));
    if (effects.size() < 3)
      matrix.notes.push_back(fmt::format("the mass across the {} measured at {} stays: nothing was measured there",
                                         effects.size() == 1 ? "direction" : "directions", sensor.point));
    matrix.measured = std::move(freed.response);
  }
  return doubts;
}

}  // namespace thinwall::app

#include "setup/sensor_mass.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/messages.hpp"
#include "core/units.hpp"
#include "coupling/decoupling.hpp"
#include "reduction/identification.hpp"

namespace thinwall::setup {

namespace {

/// "R.x by up to 4 % at 812.0 Hz (lowest resonance from 801.2 to 808.4 Hz), …"
std::string text_of(const std::vector<SensorEffect>& effects) {
  std::string text;
  for (const SensorEffect& effect : effects) {
    text += fmt::format("{}{} by up to {:.3g} % at {:.1f} Hz", text.empty() ? "" : ", ", effect.dof,
                        effect.largest_change * 100.0, effect.at_frequency_hz);
    if (effect.resonance_with_hz && effect.resonance_without_hz)
      text += fmt::format(" (lowest resonance from {:.1f} to {:.1f} Hz)", *effect.resonance_with_hz,
                          *effect.resonance_without_hz);
  }
  return text;
}

std::optional<double> lowest_resonance(const dynamics::FrequencyAxis& axis, const Eigen::VectorXcd& H) {
  try {
    return reduction::identify_modes(axis, H).front().frequency_hz;
  } catch (const core::InputError&) {
    return std::nullopt;
  }
}

}  // namespace

std::vector<SensorEffect> sensor_effects(const dynamics::ResponseModel& with, const dynamics::ResponseModel& without,
                                         const std::string& point) {
  std::vector<SensorEffect> effects;
  for (const int row : dynamics::rows_of_point(with.responses, point)) {
    const dynamics::Dof& dof = with.responses[static_cast<std::size_t>(row)];
    if (dof.kind != dynamics::DofKind::translation) continue;
    const std::string name = dynamics::name(dof);
    const Eigen::VectorXcd G = dynamics::entry(with, name, name), H = dynamics::entry(without, name, name);
    SensorEffect effect{name, 0.0, 0.0, lowest_resonance(with.axis, G), lowest_resonance(with.axis, H)};
    for (Eigen::Index line = 0; line < G.size(); ++line) {
      const double change = std::abs(H(line) - G(line)) / std::abs(G(line));
      if (!(change > effect.largest_change)) continue;
      effect.largest_change = change;
      effect.at_frequency_hz = with.axis.hz(line);
    }
    effects.push_back(std::move(effect));
  }
  return effects;
}

dynamics::ResponseModel without_sensors(dynamics::ResponseModel measured, const std::vector<Sensor>& sensors,
                                        const std::string& whose) {
  for (const Sensor& sensor : sensors) {
    dynamics::ResponseModel without = coupling::remove_point_mass(measured, sensor.point, sensor.mass).response;
    const auto effects = sensor_effects(measured, without, sensor.point);
    core::inform(fmt::format("{} sensor of {} at {} is taken off, which changes {}", whose,
                             core::readable_text(sensor.mass, core::kind::mass), sensor.point, text_of(effects)));
    if (effects.size() < 3)
      core::inform(fmt::format("its mass across the {} measured at {} stays: nothing was measured there",
                               effects.size() == 1 ? "direction" : "directions", sensor.point));
    measured = std::move(without);
  }
  return measured;
}

}  // namespace thinwall::setup

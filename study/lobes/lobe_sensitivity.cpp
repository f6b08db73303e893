#include "study/lobes/lobe_sensitivity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/messages.hpp"
#include "milling/chart/sensitivity.hpp"

namespace thinwall::study {

namespace {

std::vector<ParameterSensitivity> named(const milling::DepthSensitivity& s, const Eigen::VectorXcd& poles) {
  std::vector<ParameterSensitivity> list;
  list.reserve(static_cast<std::size_t>(3 * poles.size()) + 3);
  for (Eigen::Index k = 0; k < poles.size(); ++k) {
    const double own_hz = std::abs(poles(k)) / (2.0 * std::numbers::pi);
    list.push_back({"frequency", own_hz, s.to_frequency(k)});
    if (poles(k).imag() != 0.0) list.push_back({"damping_ratio", own_hz, s.to_damping_ratio(k)});
    list.push_back({"receptance", own_hz, -s.to_mass(k)});
  }
  list.push_back({"K_t", {}, s.to_K_t});
  list.push_back({"K_r", {}, s.to_K_r});
  list.push_back({"K_a", {}, s.to_K_a});
  std::ranges::stable_sort(list, std::ranges::greater(),
                           [](const ParameterSensitivity& p) { return std::abs(p.value); });
  return list;
}

}  // namespace

std::vector<ParameterSensitivity> parameter_sensitivities(const milling::RelativeStructure& structure,
                                                          const milling::MillingProcess& process,
                                                          double spindle_speed_rpm, const milling::LobePoint& point,
                                                          const milling::StabilityOptions& options) {
  try {
    return named(milling::depth_sensitivity(structure, process, spindle_speed_rpm, point, options), structure.poles);
  } catch (const core::NumericalError& error) {
    core::warn(fmt::format("no sensitivities at {:.0f} rpm: {}", spindle_speed_rpm, error.what()));
    return {};
  }
}

}  // namespace thinwall::study

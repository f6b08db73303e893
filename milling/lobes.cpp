#include "milling/lobes.hpp"

#include <algorithm>
#include <optional>
#include <sstream>

#include "core/error.hpp"
#include "core/parallel.hpp"

namespace thinwall::milling {

namespace {

void summarise(Lobes& lobes) {
  const auto least = std::min_element(lobes.rows.begin(), lobes.rows.end(), [](const LobeRow& a, const LobeRow& b) {
    return a.limiting_depth_m < b.limiting_depth_m;
  });
  lobes.minimum_depth_m = least->limiting_depth_m;
  lobes.at_spindle_speed_rpm = least->spindle_speed_rpm;
  for (const LobeRow& row : lobes.rows) {
    if (row.at_limit) ++lobes.rows_at_limit;
    else lobes.worst_error_estimate = std::max(lobes.worst_error_estimate, row.error_estimate);
    const bool sound = row.status == StabilityStatus::converged || row.status == StabilityStatus::stable_to_depth_limit;
    if (!sound) ++lobes.rows_not_converged;
  }
}

}  // namespace

std::vector<double> spindle_speeds(double from_rpm, double to_rpm, int count) {
  if (!(from_rpm > 0.0) || !(to_rpm > from_rpm) || count < 2) {
    std::ostringstream text;
    text << "spindle speeds: " << count << " from " << from_rpm << " to " << to_rpm
         << " rpm, must be at least 2, rising from above 0; correct the speed range";
    throw core::InputError(text.str());
  }
  std::vector<double> speeds(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    speeds[static_cast<std::size_t>(i)] = from_rpm + (to_rpm - from_rpm) * i / (count - 1);
  }
  return speeds;
}

Lobes stability_lobes(const LobeMethod& method, const std::vector<double>& spindle_speeds_rpm) {
  if (spindle_speeds_rpm.empty())
    throw core::InputError("stability lobes: no spindle speeds, at least 1 is needed; give a range");
  Lobes lobes;
  lobes.method = method.name();
  lobes.residual_share = method.residual_share();
  lobes.rows.resize(spindle_speeds_rpm.size());
  constexpr std::size_t block = 8;  // of speeds, whose searches begin at their neighbour's limit
  core::parallel_for((lobes.rows.size() + block - 1) / block, [&](std::size_t b) {
    std::optional<double> expected;
    for (std::size_t i = block * b; i < std::min(lobes.rows.size(), block * (b + 1)); ++i) {
      lobes.rows[i] = method.limiting_depth(spindle_speeds_rpm[i], expected);
      expected = lobes.rows[i].limiting_depth_m;
    }
  });
  summarise(lobes);
  return lobes;
}

Lobes stability_lobes(const RelativeStructure& structure, const MillingProcess& process,
                      const std::vector<double>& spindle_speeds_rpm, const StabilityOptions& options) {
  return stability_lobes(*lobe_method(Method::direct, structure, process, {options}), spindle_speeds_rpm);
}

}  // namespace thinwall::milling

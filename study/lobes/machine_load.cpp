#include "study/lobes/machine_load.hpp"

#include "setup/milling_process.hpp"

namespace thinwall::study {

std::optional<milling::CutLoad> load_of(const setup::CutSetup& source, const milling::MillingProcess& process) {
  const auto feed = setup::feed_per_tooth(source);
  if (!feed || source.tool->end != setup::ToolEnd::flat) return std::nullopt;
  return milling::cut_load(process, *feed);
}

bool can_do(const milling::MachineLimits& machine, const std::optional<milling::CutLoad>& load,
            const milling::OperatingPoint& point) {
  const double rpm = point.spindle_speed_rpm;
  if (rpm < machine.min_spindle_speed_rpm || rpm > machine.max_spindle_speed_rpm) return false;
  if (!load) return true;
  return rpm <= speed_for_feed_rate(*load, machine) && point.depth_m <= depth_for_torque(*load, machine) &&
         point.depth_m <= depth_for_power(*load, machine, rpm);
}

}  // namespace thinwall::study

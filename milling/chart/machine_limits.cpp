#include "milling/chart/machine_limits.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "core/error.hpp"

namespace thinwall::milling {

namespace {

using std::numbers::pi;

/// The integrals over the arcs where sin φ > 0: ∫ sin φ dφ and ∫ dφ.
struct ChipArc {
  double sine = 0.0;
  double angle_rad = 0.0;
};

ChipArc chip_arc(const std::vector<Engagement>& arcs) {
  ChipArc sum;
  for (const Engagement& arc : arcs) {
    for (double front = 2.0 * pi * std::floor(arc.entry_rad / (2.0 * pi)); front < arc.exit_rad; front += 2.0 * pi) {
      const double from = std::max(arc.entry_rad, front);
      const double to = std::min(arc.exit_rad, front + pi);
      if (to <= from) continue;
      sum.sine += std::cos(from) - std::cos(to);
      sum.angle_rad += to - from;
    }
  }
  return sum;
}

}  // namespace

std::vector<std::string> validate(const MachineLimits& machine) {
  std::vector<std::string> violations;
  const auto require = [&](bool holds, const char* what, double value, const char* bound) {
    if (holds) return;
    std::ostringstream text;
    text << "machine: " << what << " is " << value << ", must be " << bound << "; correct the machine's limits";
    violations.push_back(text.str());
  };
  const double low = machine.min_spindle_speed_rpm;
  require(low >= 0.0 && std::isfinite(low), "lowest spindle speed in rpm", low, "at least 0");
  require(machine.max_spindle_speed_rpm > low, "highest spindle speed in rpm", machine.max_spindle_speed_rpm,
          "above the lowest");
  require(machine.max_power_W > 0.0, "power in W", machine.max_power_W, "above 0");
  require(machine.max_torque_Nm > 0.0, "torque in N m", machine.max_torque_Nm, "above 0");
  require(machine.max_feed_rate_m_s > 0.0, "feed rate in m/s", machine.max_feed_rate_m_s, "above 0");
  require(machine.efficiency > 0.0 && machine.efficiency <= 1.0, "efficiency", machine.efficiency,
          "above 0 and at most 1");
  return violations;
}

CutLoad cut_load(const MillingProcess& process, double feed_per_tooth_m) {
  const Cutter& cutter = process.cutter;
  if (!(feed_per_tooth_m > 0.0) || !std::isfinite(feed_per_tooth_m)) {
    std::ostringstream text;
    text << "cutting load: feed per tooth " << feed_per_tooth_m << " m, must be positive; give the feed";
    throw core::InputError(text.str());
  }
  if (!cutter.envelope.straight() || cutter.envelope.taper_rad != 0.0) {
    throw core::InputError(
        "cutting load: the end of the tool is not flat, its radius must be the same along the depth; leave out the "
        "machine's power and torque");
  }
  const ChipArc chips = chip_arc(arcs(process));
  CutLoad load;
  for (int j = 0; j < cutter.teeth; ++j) {
    const CuttingCoefficients& k = coefficients(process, j);
    const double feed = feed_per_tooth_m * cutter.pitch_rad(j) / cutter.pitch_rad();
    load.torque_per_depth_N +=
        cutter.diameter_m / (4.0 * pi) *
        (k.K_t * feed * chips.sine + k.K_te * edge_length_per_height(cutter, j, 0.0) * chips.angle_rad);
  }
  load.feed_per_turn_m = cutter.teeth * feed_per_tooth_m;
  load.removal_per_depth_turn_m2 = 0.5 * cutter.diameter_m * load.feed_per_turn_m * chips.sine;
  return load;
}

double depth_for_torque(const CutLoad& load, const MachineLimits& machine) {
  return load.torque_per_depth_N > 0.0 ? machine.max_torque_Nm / load.torque_per_depth_N : MachineLimits::none;
}

double depth_for_power(const CutLoad& load, const MachineLimits& machine, double spindle_speed_rpm) {
  const double power_per_depth = 2.0 * pi * spindle_speed_rpm / 60.0 * load.torque_per_depth_N;
  return power_per_depth > 0.0 ? machine.efficiency * machine.max_power_W / power_per_depth : MachineLimits::none;
}

double speed_for_feed_rate(const CutLoad& load, const MachineLimits& machine) {
  return load.feed_per_turn_m > 0.0 ? 60.0 * machine.max_feed_rate_m_s / load.feed_per_turn_m : MachineLimits::none;
}

}  // namespace thinwall::milling

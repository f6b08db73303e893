#pragma once
// The milling process: everything about a cut but its speed, its depth and the structure that it shakes.

#include <string>
#include <vector>

#include "milling/cutting_force.hpp"
#include "milling/engagement.hpp"
#include "milling/tool.hpp"

namespace thinwall::milling {

struct MillingProcess {
  Cutter cutter;
  CuttingCoefficients coefficients;
  Engagement engagement;
  ToolFrame frame;
};

/// Every violation of every member, empty if there is none.
[[nodiscard]] std::vector<std::string> validate(const MillingProcess& process);

/// Throws InputError with all violations in one line, if there are any.
void require_valid(const std::vector<std::string>& violations);

/// T = 60/(z n), s: the tooth period, which is the delay of regeneration. Throws InputError unless n > 0 and finite.
[[nodiscard]] double tooth_period_s(const Cutter& cutter, double spindle_speed_rpm);

}  // namespace thinwall::milling

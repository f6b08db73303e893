#pragma once
// The milling process: everything about a cut but its speed, its depth and the structure that it shakes.

#include <string>
#include <vector>

#include "milling/cut/cutting_force.hpp"
#include "milling/cut/engagement.hpp"
#include "milling/cut/force_law.hpp"
#include "milling/cut/process_damping.hpp"
#include "milling/cut/tool.hpp"

namespace thinwall::milling {

/// The cut: tool, force law, engagement, axes.
struct MillingProcess {
  Cutter cutter;
  CuttingCoefficients coefficients;
  Engagement engagement;
  ToolFrame frame;
  std::vector<Engagement> further_engagements = {};          ///< arcs of the turn besides `engagement`
  std::vector<CuttingCoefficients> tooth_coefficients = {};  ///< one a tooth, in place of `coefficients`; empty: alike
  ProcessDamping damping = {};
};

/// All arcs, `engagement` first.
[[nodiscard]] std::vector<Engagement> arcs(const MillingProcess& process);

/// The coefficients of one tooth.
[[nodiscard]] const CuttingCoefficients& coefficients(const MillingProcess& process, int tooth);

/// True if the cut repeats itself with every tooth: equal pitches, helices and coefficients.
[[nodiscard]] bool equal_teeth(const MillingProcess& process);

/// True if every tooth leaves the surface that the one before it left: equal teeth without runout.
[[nodiscard]] bool equal_surfaces(const MillingProcess& process);

/// True if A(t) of cutting_force.hpp says it all: equal teeth without helix on a cylinder, one arc, no process damping.
/// Methods that know nothing else refuse what is not.
[[nodiscard]] bool elementary(const MillingProcess& process);

/// The law's tangent at the mean chip of each tooth (chip_load.hpp) for `coefficients`, and for `tooth_coefficients`
/// where unequal pitches or runout give teeth chips of their own. Throws InputError if a tooth never cuts (its pitch
/// then belongs to the next one), or where the chip changes along the edge: on a ball, a bull nose, a cone.
void set_force_law(MillingProcess& process, const ForceLaw& law, double feed_per_tooth_m);

/// Every violation of every member, empty if there is none; arcs that overlap are one.
[[nodiscard]] std::vector<std::string> validate(const MillingProcess& process);

/// Throws InputError with all violations in one line, if there are any.
void require_valid(const std::vector<std::string>& violations);

/// T = 60/(z n), s: the tooth period, which is the delay of regeneration. Throws InputError unless n > 0 and finite.
[[nodiscard]] double tooth_period_s(const Cutter& cutter, double spindle_speed_rpm);

}  // namespace thinwall::milling

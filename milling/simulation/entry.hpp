#pragma once
// The way in which the mean motion of a tool that enters the material approaches its end.

#include "milling/simulation/simulation.hpp"

namespace thinwall::milling {

/// The approach of a displacement to its end, of means over a tooth period (Bondarenko 2012, Tables 1 and 2).
struct Approach {
  double final_m = 0.0;       ///< mean over the last tenth of the trace
  double overshoot = 0.0;     ///< largest value over `final_m`, less one; 0 if it never goes beyond
  double peak_s = 0.0;        ///< the moment of that value, since the trace began
  double settling_2_s = 0.0;  ///< up to the last mean that is 2 % or more of `final_m` off, from the trace's begin
  double settling_5_s = 0.0;  ///< the same of 5 %
};

/// The approach along a direction, 0 to 2 for x_T to z_T. Moments are those of the middles of tooth periods, settling
/// ends with the period. Throws InputError if the trace does not have at least twenty tooth periods, or if the samples
/// are not a whole number a tooth period.
[[nodiscard]] Approach approach_of(const Trace& trace, int direction, double tooth_period_s);

}  // namespace thinwall::milling

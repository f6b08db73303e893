#pragma once
// The way in which the mean motion of a tool that enters the material approaches its end.

#include <Eigen/Core>
#include <optional>

namespace thinwall::milling {

/// The approach of a displacement to its end, of means over a tooth period (Bondarenko 2012, Tables 1 and 2).
struct Approach {
  double final_m = 0.0;                ///< mean over the last tenth
  double overshoot = 0.0;              ///< largest value over `final_m`, less one; 0 if it never goes beyond
  double peak_s = 0.0;                 ///< the moment of that value, since the first mean began
  std::optional<double> settling_2_s;  ///< up to the last mean that is 2 % or more of `final_m` off; none where that
                                       ///< lies in the last tenth, for the motion has not settled then
  std::optional<double> settling_5_s;  ///< the same of 5 %
};

/// The approach of the means over one period of time after the other, as SimulatedCut::means_m has them along a
/// direction. Moments are those of the middles of periods, settling ends with the period. All zero where `final_m` is.
/// Throws InputError for fewer than twenty means or one that is not finite.
[[nodiscard]] Approach approach_of(const Eigen::VectorXd& means_m, double period_s);

}  // namespace thinwall::milling

#pragma once
// A stability chart that holds although the structure and the coefficients are known with an uncertainty only.

#include <vector>

#include "milling/chart/sensitivity.hpp"
#include "milling/cut/process.hpp"
#include "milling/structure/relative_structure.hpp"

namespace thinwall::milling {

/// The robust limit at one speed.
struct RobustRow {
  double spindle_speed_rpm = 0.0;
  double relative_uncertainty = 0.0;  ///< of the limiting depth there, standard, first order; 0 where no crossing is
                                      ///< known, infinite where its sensitivity is not
  double depth_m = 0.0;               ///< robust limiting depth; 0: not robust at any
  bool at_limit = false;              ///< robust up to the depth limit
  bool converged = true;              ///< every limit that this comes from
};

/// The robust chart.
struct RobustLobes {
  std::vector<RobustRow> rows;        ///< in the order of the speeds
  double minimum_depth_m = 0.0;       ///< the robust absolute minimum
  double at_spindle_speed_rpm = 0.0;  ///< where that is
  int rows_not_robust = 0;            ///< at any depth
  int rows_not_converged = 0;
};

/// The largest change of frequencies that is followed, as a share.
constexpr double most_reach = 0.5;

/// The multiple k' of u_f over which frequencies are varied, beyond which on either side as much probability lies as
/// below k standard deviations on one, erfc(k'/√2) = erfc(k/√2)/2. k = 2: k' = 2.28.
[[nodiscard]] double two_sided_coverage(double confidence);

/// The robust limiting depth at n. A change of all natural frequencies by the share δ, at constant modal masses and
/// damping ratios, moves the chart as a whole, w_δ(n) = (1 + δ)² w(n/(1 + δ)), exactly, and steep flanks of lobes make
/// that more than a slope can say. Of what else is uncertain first order tells the worst direction, and the limit there
/// is computed as it is:
///
///     w_r(n) = min over |δ| ≤ k' u_f of (1 + δ)² [w(n') − √(1 − (δ/k' u_f)²) (w(n') − w_k(n'))],     n' = n/(1 + δ)
///
/// with w_k ≤ w the least limit found k standard uncertainties away: down the slope of depth_sensitivity() at n', in
/// units of the uncertainties, then in the mean direction of that and of the slope there, while that gains a hundredth
/// (four steps at most; two equal modes need them). Of the frequencies' sensitivities s the part that a common change
/// explains, (Σ s) |s_j|/Σ|s|, is taken off. w_k is 0 where no structure is that far. The root shares k among the two,
/// as independent uncertainties do. `confidence` k: for normal distributions a share Φ(k) of the structures is stable
/// there as a rule (97.7 % with k = 2). n' are the speeds and enough others that k' u_f has four steps,
/// `spindle_speeds_rpm` ascending. The limit w is looked for to twice the depth limit where the envelope is straight,
/// so that a cut that is stable to the limit by little is not taken for robust; where it is stable to the end of that,
/// w_k is the limit with k standard uncertainties less damping of every mode, lighter modes and higher coefficients at
/// once, which is on the safe side. R moves with the chart in a common change of frequencies and stays otherwise.
/// Speeds are shared out among core::thread_count() threads; the result does not depend on their number. Throws
/// InputError as limiting_depth(), for a bad uncertainty or confidence (k > 0; k' u_f ≤ most_reach) or if there are no
/// speeds; NumericalError; Interrupted. Cost: two to five rows and one to four depth_sensitivity() for every n'.
[[nodiscard]] RobustLobes robust_lobes(const RelativeStructure& structure, const MillingProcess& process,
                                       const std::vector<double>& spindle_speeds_rpm, StabilityOptions options,
                                       const Uncertainty& uncertainty, double confidence);

}  // namespace thinwall::milling

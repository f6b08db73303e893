#pragma once
// Crossings that a row nearly has or nearly lacks.

#include "milling/chart/sampled_stability.hpp"

namespace thinwall::milling {

/// Widens the estimate of a row whose limit is another crossing for what the lines of the structure leave open.
///
/// Just beside the nose of a flip lobe a row has the Hopf crossing above the nose only, while two eigenvalues
/// a ± i√(−D) of −Z(−1) are a hair off the real axis. A change Δν (first order) is one of Re Δν in a, and of
/// 2 Im Δν √(−D) in D, so that an eigenvalue with
///
///     1/Re ν < the limit,      |Im ν| ≤ 2 |Im Δν|
///
/// may be a crossing as shallow as 1/(Re ν + |Re Δν| + √(2 |Im Δν Im ν|)): the estimate grows by the distance to that.
/// Δν is the largest change by the fits to even lines, odd lines and lines within, and five standard deviations
/// (jackknife) by those that each leave out a tenth of the lines. An eigenvalue on the path of the limiting crossing
/// itself is none. On the other side of the nose the two are real, ν₁ and ν₂, and a change of |ν₁ − ν₂|/4 makes them
/// meet: a limit by flip or fold with an estimate of as much may be none, and the estimate grows by the distance to the
/// next crossing, or by 1 where none is known.
///
/// Eigenvalues are sought at the angles of a search on the coarse grid up to the limit, those off the axis are taken
/// from a finer one. With a helix the cut keeps the shape of the limit. The status follows the estimate. Throws
/// NumericalError as CriticalDepths. Cost: that search, and for up to six eigenvalues with |Im ν| ≤ Re ν/10 a value of
/// the gain by each fit.
void widen_for_near_crossings(const FittedStructure& structure, const MillingProcess& process,
                              const StabilityOptions& options, LobeRow& row);

/// The chart with all rows widened, on all threads. Errors as above.
[[nodiscard]] Lobes widened_for_near_crossings(const FittedStructure& structure, const MillingProcess& process,
                                               const StabilityOptions& options, Lobes lobes);

/// limiting_depth() of sampled_stability.hpp before it is widened: by such rows the line of a chart is refined, which
/// would else take a nose for what no speed between can mend. Errors and cost as limiting_depth().
[[nodiscard]] LobeRow row_by_lines(const FittedStructure& structure, const MillingProcess& process,
                                   double spindle_speed_rpm, const StabilityOptions& options);

/// stability_lobes() of such rows.
[[nodiscard]] Lobes lobes_by_lines(const FittedStructure& structure, const MillingProcess& process,
                                   const std::vector<double>& spindle_speeds_rpm, const StabilityOptions& options,
                                   const KeptRows& kept = {});

/// A converged row whose estimate misses the tolerance is `data_limited`, beyond a tenth `data_insufficient`.
void judge_by_estimate(LobeRow& row, const StabilityOptions& options);

}  // namespace thinwall::milling

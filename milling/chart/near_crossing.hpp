#pragma once
// Crossings that a row nearly has or nearly lacks.

#include <Eigen/Core>

#include "milling/chart/sampled_stability.hpp"
#include "milling/direct/cut_at_speed.hpp"

namespace thinwall::milling {

/// Crossings and eigenvalues up to this many times as deep as the limit may be the limit by the lines.
inline constexpr double may_be_limit = 1.3;

/// Widens the estimate of a row whose limit is another crossing for what the lines of the structure leave open.
///
/// Just beside the nose of a flip lobe a row has the Hopf crossing above the nose only, while two eigenvalues
/// a ± i√(−D) of −Z(−1) are a hair off the real axis. A change Δν (first order) is one of Re Δν in a, and of
/// 2 Im Δν √(−D) in D, so that an eigenvalue with
///
///     1/Re ν < 1.3 times the limit,      |Im ν| ≤ 2 |Im Δν|
///
/// may be a crossing as shallow as 1/(Re ν + |Re Δν| + √(2 |Im Δν Im ν|)): the estimate grows by the distance to that,
/// if it lies below the limit by more than a hundredth, and by 1 where a fit gives no number. For a real one, which is
/// a crossing above the limit already, it grows to that distance only.
/// Δν is the largest change by the fits to even lines, odd lines and lines within, and five standard deviations
/// (jackknife) by those that each leave out a tenth of the lines. An eigenvalue on the path of the limiting crossing
/// itself is none. On the other side of the nose the two are real, ν₁ and ν₂, and a change of |ν₁ − ν₂|/4 makes them
/// meet: a limit by flip or fold with an estimate of as much may be none, and the estimate grows by the distance to the
/// next crossing, or by 1 where none is known. So does that of a limit which the finer grid lacks.
///
/// Eigenvalues are sought at the angles of a search on the coarse grid up to the limit, and taken from a finer one. At
/// θ = 0 and π all are found. Between them, the search of a large gain finds those that a depth can reach, which could
/// miss one at an angle; an eigenvalue near the axis is near it at the angles beside, too. Two that are real on the one
/// grid may be a pair on the other: where one is not found again at θ = 0 or π, all of the finer grid there are taken.
/// With a helix the cut keeps the shape of the limit. The status follows the estimate, also that of a row at the depth
/// limit once it has grown. Throws NumericalError as CriticalDepths. Cost: that search, and for up to six eigenvalues
/// below the limit and six above it with |Im ν| ≤ Re ν/10 a value of the gain by each fit.
void widen_for_near_crossings(const FittedStructure& structure, const MillingProcess& process,
                              const StabilityOptions& options, LobeRow& row);

/// The chart with all rows widened, on all threads. Errors as above.
[[nodiscard]] Lobes widened_for_near_crossings(const FittedStructure& structure, const MillingProcess& process,
                                               const StabilityOptions& options, Lobes lobes);

/// Moves a crossing of the poles of all lines to where it lies by the lines, and adds to its estimate what the lines
/// leave open, as limiting_depth() of sampled_stability.hpp says; that is 1 if the crossing is lost. Cost: some ten
/// sums over the harmonics within the lines, and the receptance of ten fits there.
void follow_to_lines(const FittedStructure& structure, const CutAtSpeed& cut, LobePoint& point);

/// limiting_depth() of sampled_stability.hpp before it is widened: by such rows the line of a chart is refined, which
/// would else take a nose for what no speed between can mend. Errors and cost as limiting_depth().
[[nodiscard]] LobeRow row_by_lines(const FittedStructure& structure, const MillingProcess& process,
                                   double spindle_speed_rpm, const StabilityOptions& options);

/// stability_lobes() of such rows.
[[nodiscard]] Lobes lobes_by_lines(const FittedStructure& structure, const MillingProcess& process,
                                   const std::vector<double>& spindle_speeds_rpm, const StabilityOptions& options,
                                   const KeptRows& kept = {});

/// The standard deviation of a number by its changes where each part of the lines in turn is left out (jackknife, Efron
/// 1982, Eq. 3.3), σ² = (g − 1)/g Σ (x_i − mean)²; 0 of none.
[[nodiscard]] double jackknife_deviation(const Eigen::ArrayXd& changes);

/// A converged row whose estimate misses the tolerance is `data_limited`, beyond a tenth `data_insufficient`.
void judge_by_estimate(LobeRow& row, const StabilityOptions& options);

}  // namespace thinwall::milling

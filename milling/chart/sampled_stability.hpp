#pragma once
// Stability from a measured or coupled receptance as it is, without poles.

#include <optional>
#include <vector>

#include "milling/chart/lobes.hpp"
#include "milling/cut/process.hpp"
#include "milling/direct/lobe_row.hpp"
#include "milling/direct/sampled_receptance.hpp"
#include "milling/structure/relative_structure.hpp"

namespace thinwall::milling {

/// The structure at the cut where something is known by samples only: both receptances add. Beside a measured tool a
/// part keeps all its modes, also those beyond the tool's lines.
struct SampledStructure {
  SampledReceptance samples;               ///< tool axes
  std::optional<RelativeStructure> poles;  ///< part axes
};

/// A sampled structure as poles, with what these leave of the lines, for all lines and thrice more
/// (fitted_receptance.hpp), which tells how much the lines leave open.
struct FittedStructure {
  /// One fit.
  struct Fit {
    RelativeStructure poles;      ///< part axes: those of the fit and those that were given
    SampledReceptance remainder;  ///< tool axes
  };
  SampledStructure lines;  ///< as they were given
  Fit all, even, odd, within;
  std::vector<Fit> without;                          ///< each without every tenth line, where there is noise
  std::optional<std::complex<double>> growing;       ///< a pole of the samples that no passive structure has, rad/s
  Eigen::Matrix3d unseen = Eigen::Matrix3d::Zero();  ///< tool axes, m/N, as that of FittedLines
};

/// The fits of a structure whose samples are in the tool axes of `frame`. Throws InputError as fitted(). Cost: that of
/// three fits.
[[nodiscard]] FittedStructure fitted_structure(const SampledStructure& structure, const ToolFrame& frame);

/// The fits with the poles of another component, part axes, beside them: what a cut feels of both. Cost: a copy.
[[nodiscard]] FittedStructure beside(FittedStructure structure, const RelativeStructure& poles);

/// The row of a speed. The crossings are those of the fit's poles, found and checked as limiting_depth() of
/// stability.hpp does. Each that bounds a stable range, or that the search has found within 1.3 times the first, so
/// that it may be the first by the lines, is then followed, on a grid of its own depth, to where it lies with the
/// remainder (harmonic_gain()), so that the row is that of the lines less their noise. The estimate of the limit
/// reaches to the least depth that a Hopf crossing among them may have. The estimate of a crossing adds
///
///  - twice the larger change of the depth if every second line alone is known: what their spacing leaves open;
///  - its change if the poles above the last line are static, or, if larger, twice its root mean square by modes above
///    the lines that are as those of their last third: what the range of the lines leaves open;
///  - five standard deviations by the scatter of ten fits, each without every tenth line (jackknife): the noise,
///    which goes beyond in one row of some 1000; to first order (gain_weights()) while no depth of the ten changes by
///    more than 3 %;
///  - the change by the remainder itself where the shape of the cut changes with the depth, because the grid is then
///    that of the depth before.
///
/// It grows by the distance to another crossing that the lines leave open, as beside the nose of a flip lobe
/// (widen_for_near_crossings() of near_crossing.hpp). A row that misses the tolerance for all this is `data_limited`,
/// beyond a tenth of the depth `data_insufficient`. A row that is stable up to the depth limit is compared with the
/// first crossing up to half as deep again, and with a Hopf crossing within a tenth of that, of edges that go on above
/// their height if need be: if one lies at w with the estimate e, and w (1 − e) is below the limit, the estimate is at
/// least what it is below by, and the row `data_limited` or `data_insufficient` if that misses the tolerance. So it is
/// by what w − 2 |w − w_h| is below the limit, w_h being the depth by every second line alone, and by all where one of
/// these rows is not known. An e of 1 or more without noise, of first order beside a nose, does not count. Edges that
/// cannot go on, as those of a taper that ends in a point, leave all open if |μ| at the limit may exceed 1 by its
/// estimate and its changes by the fits. Where the remainder is more than a tenth of the lines, as of a fit that missed
/// modes, CriticalDepths looks for a crossing of poles and remainder below the row's limit; one that is found is the
/// limit, with an estimate of 1. Any cutter will do. Throws InputError for a bad process, option or speed, and as
/// require_range(); NumericalError if an eigen-solution fails. Cost: a row from poles, and for each crossing some ten
/// sums over the harmonics within the lines, each O(harmonics contacts²), of which all but the first few fall away
/// where nothing remains of the lines, and the receptance of ten fits at the harmonics; once a row that of
/// widen_for_near_crossings(), which searches the depths up to the limit again; for a row at the limit three from
/// poles.
[[nodiscard]] LobeRow limiting_depth(const FittedStructure& structure, const MillingProcess& process,
                                     double spindle_speed_rpm, const StabilityOptions& options);

/// limiting_depth() of fitted_structure().
[[nodiscard]] LobeRow limiting_depth(const SampledStructure& structure, const MillingProcess& process,
                                     double spindle_speed_rpm, const StabilityOptions& options);

/// limiting_depth() at every speed in parallel, as the chart from poles (lobes.hpp), from one fit.
[[nodiscard]] Lobes stability_lobes(const FittedStructure& structure, const MillingProcess& process,
                                    const std::vector<double>& spindle_speeds_rpm, const StabilityOptions& options,
                                    const KeptRows& kept = {});

/// stability_lobes() of fitted_structure().
[[nodiscard]] Lobes stability_lobes(const SampledStructure& structure, const MillingProcess& process,
                                    const std::vector<double>& spindle_speeds_rpm, const StabilityOptions& options,
                                    const KeptRows& kept = {});

/// The gradient of a critical depth w with respect to the samples: g, one 3 × 3 a line (N, tool axes), with dw = Re
/// Σ_lines Σ_ij g_ij dH_ij for independent changes of real and imaginary parts. At a crossing 1/w is an eigenvalue ν of
/// −Z(e^{iθ}) with vectors l and r; from dν + ν_θ dθ = −dw/w², dθ and dw real (sensitivity.hpp),
///
///     dw = −w² Re [ (1 + i Re ν_θ/Im ν_θ) dν ],     dν = −lᵀ dZ r / lᵀ r
///
/// and Re dν alone at a flip. What continues H beyond its lines is kept as it is, so that scaling all samples by 1 + ε
/// gives dw = −ε w, Re Σ g_ij H_ij = −w, as far as no harmonic beyond the lines has a part. `point` is one of
/// limiting_depth()'s crossings for the same arguments. Errors as limiting_depth(), and NumericalError if the crossing
/// is not found again. Cost: some ten values of Z.
[[nodiscard]] std::vector<Eigen::Matrix3cd> depth_gradient(const FittedStructure& structure,
                                                           const MillingProcess& process, double spindle_speed_rpm,
                                                           const LobePoint& point, const StabilityOptions& options);

/// Requires the range that must be measured: the highest resonance f with its neighbours at the distance of a tooth
/// passing, f + z n/60 and |f − z n/60|, the harmonics that chatter at f has beside it; a first line of up to f/2 may
/// stand for what is below it. This is the least: the estimate tells what a range costs. Throws InputError that names
/// the harmonic that is missing and the range that would do.
void require_range(const SampledReceptance& receptance, const MillingProcess& process, double spindle_speed_rpm);

/// The same at every one of the speeds, for the first that lacks it. Cost: that of one speed.
void require_range(const SampledReceptance& receptance, const MillingProcess& process,
                   const std::vector<double>& spindle_speeds_rpm);

}  // namespace thinwall::milling

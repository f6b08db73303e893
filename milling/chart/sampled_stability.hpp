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

/// All crossings of a speed, as limiting_depth() of stability.hpp finds them from poles, here by CriticalDepths on
/// harmonic_gain() of the samples plus loop_gain() of the poles.
///
/// Each finer grid has more nodes and twice the harmonics, so that the change of a depth from grid to grid, which makes
/// its estimate, is that of both. Nodes start with the highest line that matters: |H| of a twentieth of the largest, or
/// enough to regenerate at the depth that is called stable (2 w ‖D̄‖ |H| ≥ ½); harmonics with four times its frequency.
/// Beyond its lines the receptance is continued as that of an oscillator of its highest resonance; twice what
/// the depth moves by with a plain static or inertia line instead is added to the estimate, and a row that misses the
/// tolerance for it is `range_limited`.
///
/// The counts that check the search are Nyquist's (unstable_count.hpp), at its end on the grid of the search and just
/// below the first crossing on the next finer one. Without poles there is no |μ|: a row that is stable up to the limit
/// has the frequency that comes closest to chatter there, by |1 − wν|, and no estimate (0).
///
/// Throws InputError for a bad process, option or speed, teeth of unequal pitch or a helix (the cut must repeat itself
/// with the tooth and not change with its depth), receptances without resonance or whose lines do not reach the
/// harmonics next to the highest resonance (require_range()); NumericalError if an eigen-solution fails. Cost: some
/// hundred sums over the harmonics, each O(harmonics nodes²).
[[nodiscard]] LobeRow limiting_depth(const SampledStructure& structure, const MillingProcess& process,
                                     double spindle_speed_rpm, const StabilityOptions& options);

/// limiting_depth() at every speed in parallel, as the chart from poles (lobes.hpp).
[[nodiscard]] Lobes stability_lobes(const SampledStructure& structure, const MillingProcess& process,
                                    const std::vector<double>& spindle_speeds_rpm, const StabilityOptions& options,
                                    const KeptRows& kept = {});

/// The gradient of a critical depth w with respect to the samples: g, one 3 × 3 a line (N, tool axes), with dw = Re
/// Σ_lines Σ_ij g_ij dH_ij for independent changes of real and imaginary parts. At a crossing 1/w is an eigenvalue ν of
/// −Z(e^{iθ}) with vectors l and r; from dν + ν_θ dθ = −dw/w², dθ and dw real (sensitivity.hpp),
///
///     dw = −w² Re [ (1 + i Re ν_θ/Im ν_θ) dν ],     dν = −lᵀ dZ r / lᵀ r
///
/// and Re dν alone at a flip. What continues H beyond its lines is kept as it is. Scaling all samples by 1 + ε gives
/// dw = −ε w: Re Σ g_ij H_ij = −w where nothing else moves. `point` is one of limiting_depth()'s crossings for the same
/// arguments. Errors as limiting_depth(), and NumericalError if the crossing is not found again. Cost: some ten values
/// of Z.
[[nodiscard]] std::vector<Eigen::Matrix3cd> depth_gradient(const SampledStructure& structure,
                                                           const MillingProcess& process, double spindle_speed_rpm,
                                                           const LobePoint& point, const StabilityOptions& options);

/// Requires the range that must be measured: the highest resonance f with its neighbours at the distance of a tooth
/// passing, f + z n/60 and |f − z n/60|, the harmonics that chatter at f has beside it; a first line of up to f/2 may
/// stand for what is below it. This is the least: the estimate tells what a range costs. Throws InputError that names
/// the harmonic that is missing and the range that would do.
void require_range(const SampledReceptance& receptance, const MillingProcess& process, double spindle_speed_rpm);

}  // namespace thinwall::milling

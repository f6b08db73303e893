#pragma once
// One cut at one speed, discretised as finely as is asked.

#include <Eigen/Core>
#include <complex>

#include "milling/direct/critical_depths.hpp"
#include "milling/direct/lobe_row.hpp"
#include "milling/structure/regenerative_loop.hpp"

namespace thinwall::milling {

/// The part of a cut that does not change with resolution and depth. Keeps a reference to the process.
struct CutAtSpeed {
  RelativeStructure structure;  ///< tool axes
  const MillingProcess& process;
  Eigen::Matrix3Xd yielding;  ///< yielding_directions() of the structure
  double spindle_speed_rpm = 0.0;
};

/// `structure` in part axes. Throws InputError unless the speed is positive and the structure moves in the cut's plane.
[[nodiscard]] CutAtSpeed cut_at_speed(const RelativeStructure& structure, const MillingProcess& process,
                                      double spindle_speed_rpm);

/// The loop on one grid. With a helix it belongs to one depth.
struct DiscreteCut {
  ContactGrid grid;
  RegenerativeLoop loop;
};

/// The cut on a grid of a resolution at a depth, m.
[[nodiscard]] DiscreteCut discrete(const CutAtSpeed& cut, Resolution resolution, double depth_m);

/// The loop's gain on the unit circle; it keeps a reference to the loop.
[[nodiscard]] GainOnCircle gain_of(const DiscreteCut& d);

/// Elements of at most 14 rad, and nodes for the phase, of the fastest mode that matters: every mode that could
/// regenerate at this depth, with loop gain 2 w ‖D̄‖ ‖φ‖ ‖b‖ / |Re λ| of at least a half, and any with a share of the
/// highest gain, a twentieth, so that the grid serves up to twenty times this depth. A grid that does not see a mode
/// would call it stable.
[[nodiscard]] Resolution resolving(const CutAtSpeed& cut, double depth_m);

/// |λ| of that mode, rad/s; `stiffness` is the norm of the mean directional matrix, N/m².
[[nodiscard]] double fastest_that_matters(const CutAtSpeed& cut, double stiffness, double depth_m);

/// As resolving(), of a grid for this depth alone: every mode whose loop gain 2 w ∫ |bᵀ D φ| dt / (T |Re λ|), by itself
/// or with a mode close to it, is at least a half, or a fifth of the highest, which is 2.5 about the first crossing. A
/// mode chatters by itself from a gain of two on, or of one where the teeth push it in short blows.
[[nodiscard]] Resolution resolving_alone(const CutAtSpeed& cut, double depth_m);

/// The grid on which a row is searched about a depth: resolving_alone() where the depth shapes the cut, so that each
/// one has a grid of its own, else resolving().
[[nodiscard]] Resolution searching(const CutAtSpeed& cut, double depth_m);

/// The error that a grid may have for the modes that it does not resolve, whose phase in the cut is r > 1 times 1/0.35
/// rad a node: 0.005 g min(1, e^{10 (r − 1.4)}) of the one for which it is largest, g its loop gain times the share of
/// the cut, 1 at most, in which it swings once it is excited. The distance of two grids that both miss a mode does not
/// show it, as they may err alike: a wall with modes up to 51 kHz had 53 of 200 rows beyond their estimates, up to
/// sixteenfold, errors of up to 0.005 of the gains that were missed, and a tenth of that at r = 1.2.
[[nodiscard]] double unresolved(const CutAtSpeed& cut, Resolution resolution, double depth_m);

/// The coarsest grid on which unresolved() is below a quarter of the tolerance, in elements of at most 20 rad, but of
/// no more than options.most_nodes.
[[nodiscard]] Resolution estimating(const CutAtSpeed& cut, double depth_m, const StabilityOptions& options);

/// True if `a` has fewer nodes than `b`.
[[nodiscard]] bool coarser(Resolution a, Resolution b);

/// Half as fine again, or about.
[[nodiscard]] Resolution finer(Resolution r);

/// Likewise, but no coarser than `least`.
[[nodiscard]] Resolution finer(Resolution r, Resolution least);

/// A depth, m, at which the loop gain 2 w ‖D̄‖ Σ ‖φ‖ ‖b‖ / |Re λ|, each mode at its own resonance, is a half.
[[nodiscard]] double surely_stable_depth_m(const CutAtSpeed& cut);

/// All Floquet multipliers of the period at a depth (that of the grid, with a helix). Throws NumericalError if the
/// eigen-solution fails.
[[nodiscard]] Eigen::VectorXcd multipliers(const DiscreteCut& d, double depth_m);

/// The number of multipliers outside of the unit circle; the largest int where multipliers() would fail, as where
/// chatter grows within a period by more than the digits of a double: the cut is far from stable there.
[[nodiscard]] int unstable(const DiscreteCut& d, double depth_m);

/// True if the largest multiplier exceeds a modulus: by Arnoldi's process on the map (dominant_eigenvalue.hpp), which
/// takes some fifty products with it in place of all eigenvalues, and by multipliers() where that does not settle. Also
/// true where multipliers() would fail.
[[nodiscard]] bool exceeds(const DiscreteCut& d, double depth_m, double modulus);

/// True if no multiplier lies outside of the unit circle: by powers_vanish(), or where that cannot tell by the count.
[[nodiscard]] bool stable(const DiscreteCut& d, double depth_m);

/// The chatter frequency of chatter_frequency.hpp, from the poles.
[[nodiscard]] double chatter_frequency_hz(const CutAtSpeed& cut, const ContactGrid& grid, double theta_rad,
                                          const Eigen::VectorXcd& c);

/// The modulation that belongs to a multiplier at a depth: the null vector of I + w Z(μ).
[[nodiscard]] Eigen::VectorXcd modulation(const DiscreteCut& d, double depth_m, std::complex<double> mu);

}  // namespace thinwall::milling

#pragma once
// The zeroth-order solution: the cut with its mean directional matrix, in closed form.

#include <Eigen/Core>
#include <vector>

#include "milling/direct/cut_at_speed.hpp"
#include "milling/direct/found_crossings.hpp"

namespace thinwall::milling {

/// A point of the boundary at a frequency, before a speed is chosen (Altintas & Budak 1995). With A_0 the mean of the
/// directional matrix over a pitch and λ an eigenvalue of G(ω) A_0, the loop q = −w (1 − e^{−iψ}) G A_0 q closes where
///
///     1 − e^{−iψ} = −1/(w λ),   so that   w = −1/(2 Re λ),   e^{−iψ} = 1 + 1/(w λ)
///
/// and ψ = ωT up to whole waves. (Their Λ is −1/λ, over constants.)
struct ZerothOrderPoint {
  double omega_rad_s = 0.0;
  double depth_m = 0.0;
  double phase_rad = 0.0;  ///< ψ, between two waves, 0 to 2π
};

/// The speed at which this point lies on a lobe, `lobe` = 0, 1 … whole waves between two teeth: T = (ψ + 2π lobe)/ω,
/// n = 60/(z T), rpm.
[[nodiscard]] double lobe_speed_rpm(const ZerothOrderPoint& point, int lobe, int teeth);

/// All boundary points, Re λ < 0, in ascending frequency up to `highest_rad_s`; frequencies lie a fifth of the distance
/// to the nearest pole apart. `structure` in part axes. Throws InputError for a bad process or unequal teeth. A helix
/// is as good as none: the mean is the same. Cost: an eigenvalue problem of size ≤ 3 a frequency.
[[nodiscard]] std::vector<ZerothOrderPoint> zeroth_order_boundary(const RelativeStructure& structure,
                                                                  const MillingProcess& process, double highest_rad_s);

/// The point of least depth, refined in frequency by golden sections to round-off. Throws InputError as above,
/// NumericalError if no frequency has a boundary point.
[[nodiscard]] ZerothOrderPoint zeroth_order_minimum(const RelativeStructure& structure, const MillingProcess& process);

/// All crossings at the cut's speed up to `follow` times the first, or the depth limit: frequencies at which the phase
/// of −(1 − e^{−iωT}) λ(ω), whose reciprocal is the depth, passes 0. The estimate of a crossing is its distance from
/// the one with `harmonics` harmonics that Newton's rule leads to (multi_frequency.hpp), 1 if it leads nowhere: it is
/// that of the averaging; the closed form itself is exact. Throws InputError as above. Cost: an eigenvalue problem of
/// size ≤ 3 at some hundred frequencies, and an inverse of the multi-frequency gain a crossing.
[[nodiscard]] FoundCrossings zeroth_order_crossings(const CutAtSpeed& cut, int harmonics,
                                                    const StabilityOptions& options);

}  // namespace thinwall::milling

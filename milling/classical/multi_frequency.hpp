#pragma once
// The multi-frequency solution: the cut whose directional matrix is cut off after a few harmonics, in the frequency
// domain.

#include <Eigen/Core>
#include <vector>

#include "milling/direct/cut_at_speed.hpp"
#include "milling/direct/found_crossings.hpp"

namespace thinwall::milling {

/// Harmonics A_0 … A_h of the directional matrix over its period θ_p, tool axes, N/m²:
///
///     A(θ) = Σ_r A_r e^{2πi r θ/θ_p},      A_r = ∫ A e^{−2πi r θ/θ_p} dθ / θ_p,      A_{−r} = conj A_r
///
/// Gauss's sums over the stretches of the cut, to round-off. `highest` = h ≥ 0. Equal teeth only (InputError). A_0, the
/// mean, is the same for any helix and depth; for the others the helix is taken as none. Cost O(h nodes).
[[nodiscard]] std::vector<Eigen::Matrix3cd> directional_harmonics(const MillingProcess& process, int highest);

/// The loop's gain of that cut (Budak & Altintas 1998; Merdol & Altintas 2004). The motion Σ q_k e^{iω_k t},
/// ω_k = (θ + 2πk)/T, answers the harmonics of its force:
///
///     q = −w Z q,      Z_kl = (1 − e^{−iθ}) G(ω_k) A_{k−l}
///
/// Motion harmonics from −K − 1 to K reach to twice the fastest mode that matters at `depth_m` and h beyond it, so that
/// one window of θ from 0 to π holds what the papers find by moving the frequency over all modes, and a single mean
/// matrix (h = 0) gives all lobes of the zeroth-order solution. At θ = π the harmonics k and −1 − k are conjugate: an
/// even number of them is closed, and values at as many equal times, a unitary change of basis, make Z real there. (At
/// θ = 0 it vanishes.) In the directions `cut.yielding`, so of size p (2K + 2). Throws InputError if that exceeds 1200:
/// the method is not for a tool so slow. Cost of a value O(size³).
[[nodiscard]] GainOnCircle multi_frequency_gain(const CutAtSpeed& cut, const std::vector<Eigen::Matrix3cd>& harmonics,
                                                double depth_m);

/// |μ| of that cut by contact-phase collocation over the whole period (the determinant above holds on the circle only).
/// The estimate is that of the collocation alone. Throws NumericalError if an eigen-solution fails.
[[nodiscard]] Multiplier harmonic_multiplier(const CutAtSpeed& cut, const std::vector<Eigen::Matrix3cd>& harmonics,
                                             double depth_m, const StabilityOptions& options);

/// All crossings with h harmonics, by CriticalDepths; a crossing's estimate is twice its distance from the one with h/2
/// of them (1 harmonic for h = 0) that Newton's rule leads to, 1 if it leads nowhere. It is a bound once h spans twice
/// the mode's frequency in tooth passings; the error then falls as 1/h³. Throws as above.
[[nodiscard]] FoundCrossings multi_frequency_crossings(const CutAtSpeed& cut, int harmonics,
                                                       const StabilityOptions& options);

}  // namespace thinwall::milling

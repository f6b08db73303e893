#pragma once
// A sampled receptance as poles and what these leave of the lines.

#include <complex>
#include <optional>
#include <vector>

#include "milling/direct/sampled_receptance.hpp"
#include "milling/structure/relative_structure.hpp"

namespace thinwall::milling {

/// H(ω) = receptance(poles, ω) + interpolated(remainder, ω): the samples less their noise. The poles carry the
/// resonances, which polynomials between lines would miss, and continue them beyond the lines. The remainder holds what
/// the fit did not explain, and what makes poles grow that no passive structure has: these are taken as decaying.
///
/// Noise is what has nothing in common from line to line. With ρ the correlation of the rest of neighbouring lines over
/// twenty-one lines, the remainder is the share (ρ − ½)/0.4 of the rest, between 0 and 1: ρ of noise is 0 to within
/// 0.15, that of anything that lines resolve is 1.
struct FittedReceptance {
  RelativeStructure poles;      ///< tool axes
  SampledReceptance remainder;  ///< tool axes; without lines where it is below 1e-12 of the largest ‖H‖
  double noise = 0.0;           ///< root mean square of a line less both, over the largest ‖H‖
};

/// The fit of all lines; of every second one alone; and of all with no pole above the last line, the static part of
/// such poles in their place. What these differ in is what the lines leave open.
struct FittedLines {
  FittedReceptance all, even, odd, within;
  std::vector<FittedReceptance> without;        ///< ten fits, each without every tenth line; none where the noise is
                                                ///< below 1e-6
  std::optional<std::complex<double>> growing;  ///< rad/s: the pole among the lines with Re > 0 that all fits have and
                                                ///< that is largest; a passive structure has none
  Eigen::Matrix3d unseen = Eigen::Matrix3d::Zero();  ///< tool axes, m/N: root mean square at the last line of modes
                                                     ///< above it that are as those of the last third of the lines
};

/// The samples by dynamics::rational_fit(). A residue is taken apart by its singular values into at most three modes
/// with the same pole; a mode whose peak is below a tenth of what the fit leaves of a line (root mean square) stays in
/// the remainder. A pole above the last line is taken as it is only if the fits of the others have it, too, within
/// three tenths of its half width, so that its peak is known; else it is damped to 10 %, its static part unchanged.
/// No fit can tell where modes above the lines have their peaks. As many of them as in the last third of the lines,
/// which is Δω wide and ends at ω_e, and with modal masses and damping ratios as there, have the mean square
///
///     unseen_ij² = Σ_k |φ_ik b_jk|² π / (|Re λ_k| Δω) (|λ_k|/ω_e)³
///
/// for the integral of |r/(iω − λ)|² over ω is π|r|²/|Re λ|, and that of modes of one mass and damping falls as 1/ω³.
/// Throws InputError as require_usable(), and for fewer than 14 lines, of which the halves could not be fitted. Cost:
/// that of three fits.
[[nodiscard]] FittedLines fitted(const SampledReceptance& samples);

/// The poles of the fit of all lines alone, fitted().all.poles. Errors as fitted(). Cost: that of three fits, less its
/// remainders and the fits without every tenth line.
[[nodiscard]] RelativeStructure fitted_poles(const SampledReceptance& samples);

}  // namespace thinwall::milling

#pragma once
// A sampled receptance as poles and what these leave of the lines.

#include "milling/direct/sampled_receptance.hpp"
#include "milling/structure/relative_structure.hpp"

namespace thinwall::milling {

/// H(ω) = receptance(poles, ω) + interpolated(remainder, ω), equal to the samples at their lines. The poles carry the
/// resonances, which polynomials between lines would miss, and continue them beyond the lines; the remainder holds
/// noise, and what the fit did not explain.
struct FittedReceptance {
  RelativeStructure poles;      ///< tool axes
  SampledReceptance remainder;  ///< tool axes; without lines where it is below 1e-12 of the largest ‖H‖
};

/// The samples by dynamics::rational_fit(). A residue is taken apart by its singular values into at most three modes
/// with the same pole; a mode whose peak is below a tenth of what the fit leaves of a line (root mean square) stays in
/// the remainder. Throws InputError as require_usable(), and for fewer than 14 lines, of which the halves could not be
/// fitted. Cost: that of the fit, a tenth of a second for thousands of lines.
[[nodiscard]] FittedReceptance fitted(const SampledReceptance& samples);

/// The same with poles that start from those of `near`, a fit of other lines of the same receptance.
[[nodiscard]] FittedReceptance fitted(const SampledReceptance& samples, const FittedReceptance& near);

}  // namespace thinwall::milling

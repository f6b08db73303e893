#pragma once
// A modal model from measured receptances without a guess.

#include <optional>
#include <vector>

#include "identification/modal_fit.hpp"
#include "identification/plscf.hpp"

namespace thinwall::identification {

/// The choices of an identification; what is empty is found from the lines.
struct IdentifyOptions {
  int highest_order = 30;              ///< of the stabilisation diagram; less where there are few lines
  Eigen::VectorXcd poles = {};         ///< rad/s; chosen by hand instead of by the diagram
  Eigen::VectorXcd start = {};         ///< rad/s; in place of those of the diagram, others are added and left out
  bool coarse = false;                 ///< ends before step 5, with free residues
  std::optional<ResidualTerms> terms;  ///< none: the fewest that the lines call for
  Residues residues = Residues::rank_one;
};

/// The fit, and the way on which it was found.
struct Identification {
  ModalFit fit;
  ResidualTerms terms;
  std::vector<OrderPoles> diagram;  ///< empty where poles were given
  std::vector<StablePole> stable;   ///< that the fit started from
  int added = 0, left_out = 0;  ///< modes, against the poles of this search's start: the diagram's, or options.start
};

/// From the stable poles of plscf():
///
/// 1. modal_fit() with free residues and the terms LR/s², c_0 and c_1 s; powers of s are added as long as they lower χ²
///    by more than chance;
/// 2. a mode whose residue is not of rank one hides another one close by: it is split, if that lowers χ² by far more
///    than chance does; then a mode is added where the lines lie farthest from the fit, under the same condition;
/// 3. a mode that lowers χ² by no more than chance is left out;
/// 4. where modes were added or left out, powers once more;
/// 5. modal_fit() with the residues that were asked for.
///
/// "By chance" is ten times the number of unknowns of modes that are added, three times that of powers, times χ² a
/// degree of freedom where that is above 1. Powers that are missing would spoil the weights of what is small, and cost
/// little. Throws InputError where no pole is stable, and as plscf() and modal_fit(). Cost: some ten to twenty fits.
[[nodiscard]] Identification identify(const MeasuredLines& measured, const IdentifyOptions& options = {});

}  // namespace thinwall::identification

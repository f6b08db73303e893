#pragma once
// Choice of the number of fixed-interface modes that a band needs.

#include <vector>

#include "reduction/full_model.hpp"
#include "reduction/methods/craig_bampton.hpp"
#include "reduction/trust/band.hpp"
#include "reduction/trust/truncation.hpp"

namespace thinwall::reduction {

/// The required accuracy of the receptance at the interface, and the effort allowed.
struct ModeCountOptions {
  double tolerance = 0.01;  ///< bound of the largest relative_error() of the band; 1e-8 … 1
  Band band;
  int verified_lines = 3;  ///< direct solves, ≥ 1, each a slow factorisation; unused with a truth
  int rounds = 10;         ///< rounds, ≥ 1; each takes modes up to 1.6 times the frequency of the last
};

/// Outcome of the choice.
enum class ModeCountStatus {
  met,  ///< the estimate is below the tolerance, and the reference was verified
  /// After all rounds, direct solves differ from the reference by more than a tenth of the tolerance, or the modes of
  /// the reference did not converge.
  not_verified,
  not_met,  ///< the estimate stays above the tolerance after all rounds
};

/// A Craig-Bampton model cut to as few modes as the tolerance allows.
struct [[nodiscard]] ChosenModes {
  CraigBampton reduced;          ///< model with the modes kept
  Truncation truncation;         ///< truncation by the modes not kept
  int modes = 0;                 ///< number of modes kept
  double estimated_error = 0.0;  ///< error of the model against the reference, largest of the band
  double reference_error = 0.0;  ///< error of the reference against the full model, the largest
  int reference_modes = 0;       ///< modes in the reference, beside those that its truncation adds
  std::vector<double> errors;    ///< estimate for 0, 1, 2 … reference_modes modes
  ModeCountStatus status = ModeCountStatus::not_met;
};

/// Throws InputError that lists every violation.
void validate(const ModeCountOptions& options);

/// Estimates of the error of docs/theory/reductions.md, Eq. 13, for a model cut to 0, 1, 2 … of its modes. With the
/// modal series of the interface's dynamic stiffness (docs/theory/reductions.md, Eq. 14),
///
///     Z_m(z) = K_bb − z M_bb − z² Σ_{r≤m} L_r L_rᵀ/(λ_r − z)
///
/// all numbers of modes cost one pass. The reference is the model with_left_out(), whose relative error in what was
/// left out is of the order (ω/ω_last)⁴. Cost O(lines · modes · interface³).
[[nodiscard]] std::vector<double> truncation_errors(const CraigBampton& reduced, const Truncation& truncation,
                                                    const Band& band);

/// The smallest model that meets a tolerance on the receptance of its interface (docs/theory/reductions.md, Eq. 13-15).
/// Fixed-interface modes up to 1.5 times the band are computed, errors are estimated from what is left out, and the
/// least number of modes whose estimate is below the tolerance is taken. The reference of the estimates is compared
/// with direct solves of the full model between and beside its resonances. If they differ by more than a tenth of the
/// tolerance, or if more modes are needed than there are, modes up to 1.6 times the frequency are computed and all is
/// repeated. Free parts need an interface that restrains them, and from_hz > 0. Throws as validate() and
/// craig_bampton() do. Cost: Craig-Bampton once a round and `verified_lines` simplicial factorisations.
ChosenModes modes_for_tolerance(const FullModel& full, const Interface& interface, const ModeCountOptions& options);

/// The smallest model that meets a tolerance, verified against an existing truth (band_truth() of the same part and
/// band) instead of direct solves: at all of its lines, whose residual in the full model's equations is known, and
/// without further factorisations.
ChosenModes modes_for_tolerance(const FullModel& full, const Interface& interface, const ModeCountOptions& options,
                                const BandTruth& truth);

}  // namespace thinwall::reduction

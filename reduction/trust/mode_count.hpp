#pragma once
// How many fixed-interface modes a band needs.

#include <vector>

#include "reduction/full_model.hpp"
#include "reduction/methods/craig_bampton.hpp"
#include "reduction/trust/band.hpp"
#include "reduction/trust/truncation.hpp"

namespace thinwall::reduction {

/// What the receptance at the interface must be good for.
struct ModeCountOptions {
  double tolerance = 0.01;  ///< relative_error() of Eq. 13, the largest of the band; 1e-8 … 1: a model sees no less
  Band band;
  int verified_lines = 3;  ///< frequencies of direct solves, ≥ 1; each costs a slow factorisation; without a truth
  int rounds = 10;  ///< ≥ 1: how often modes up to 1.6 times the frequency may be taken, 100 times the band in all
};

/// Whether the tolerance is met.
enum class ModeCountStatus {
  met,  ///< the estimate is below the tolerance, and the reference was verified
  /// after all rounds, direct solves differ from the reference by more than a tenth of the tolerance, or the modes of
  /// the reference did not converge
  not_verified,
  not_met,  ///< the estimate stays above the tolerance after all rounds
};

/// A Craig-Bampton model cut to as few modes as the tolerance allows.
struct [[nodiscard]] ChosenModes {
  CraigBampton reduced;          ///< of the modes kept
  Truncation truncation;         ///< of those that are not
  int modes = 0;                 ///< kept
  double estimated_error = 0.0;  ///< of the kept model against the reference, over the band
  double reference_error = 0.0;  ///< of the reference against the full model, the largest
  int reference_modes = 0;       ///< in the reference, beside what its truncation adds
  std::vector<double> errors;    ///< estimate for 0, 1, 2 … reference_modes modes
  ModeCountStatus status = ModeCountStatus::not_met;
};

/// Notes: throws InputError with every violation at once.
void validate(const ModeCountOptions& options);

/// Estimates of Eq. 13 for a model cut to 0, 1, 2 … of its modes. With the modal series of the interface's dynamic
/// stiffness (docs/theory/reductions.md, Eq. 14)
///
///     Z_m(z) = K_bb − z M_bb − z² Σ_{r≤m} L_r L_rᵀ/(λ_r − z)
///
/// all counts cost one pass, against the model with_left_out(), whose error is of the order (ω/ω_last)⁴ of its own.
/// Cost O(lines · modes · interface³).
[[nodiscard]] std::vector<double> truncation_errors(const CraigBampton& reduced, const Truncation& truncation,
                                                    const Band& band);

/// The smallest model for a tolerance on the receptance of its interface (docs/theory/reductions.md, Eq. 13-15): fixed-
/// interface modes up to 1.5 times the band, estimates from what is left out, the least count whose estimate is below
/// the tolerance. What the estimates rest on is compared with direct solves of the full model between and beside its
/// resonances; where it differs by more than a tenth of the tolerance, or where more modes are needed than there are,
/// those up to 1.6 times the frequency are taken and all is done again. Free parts need an interface that restrains
/// them, and from_hz > 0. Throws as validate() and craig_bampton(). Cost: Craig-Bampton once a round and
/// `verified_lines` simplicial factorisations.
ChosenModes modes_for_tolerance(const FullModel& full, const Interface& interface, const ModeCountOptions& options);

/// The same with a truth that is there already (band_truth() of the same part and band) in place of direct solves: at
/// all of its lines, whose residual in the full model's equations is known, and without further factorisations.
ChosenModes modes_for_tolerance(const FullModel& full, const Interface& interface, const ModeCountOptions& options,
                                const BandTruth& truth);

}  // namespace thinwall::reduction

#pragma once
// A mode as the numbers that are regressed over postures.

#include <Eigen/Core>

#include "identification/modal_fit.hpp"
#include "posture/tapped_posture.hpp"

namespace thinwall::posture {

/// The numbers of a mode: ln f (Hz), ln ζ, then real and imaginary parts of the entries of A = 2i ω_d residue, column
/// by column, 1/kg, ω_d = Im λ. A is φφᵀ, real, of a mode without damping, and has neither a phase nor a scale that
/// could be chosen differently at two postures, as the vectors have. Throws InputError for a mode that does not decay,
/// whose logarithm would not exist.
[[nodiscard]] Eigen::VectorXd targets_of(const identification::FittedMode& mode);

/// The mode with vectors and residue turned into the tip's frame, T_r right, T_l left, T_r residue T_lᵀ; unchanged for
/// an empty turn.
[[nodiscard]] identification::FittedMode turned(identification::FittedMode mode, const Turn& turn);

/// The turn from the tip's frame into the world's.
[[nodiscard]] Turn back(const Turn& turn);

/// The mode of such numbers, for that many responses. Its vectors are those of the nearest residue of rank one (Eckart
/// & Young 1936), the left one with largest entry 1; the residue is as the numbers say.
[[nodiscard]] identification::FittedMode mode_of(const Eigen::VectorXd& targets, Eigen::Index responses);

}  // namespace thinwall::posture

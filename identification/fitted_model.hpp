#pragma once
// A fit as models that other stages take: poles and vectors at DOFs, modal masses and stiffnesses.

#include <optional>
#include <vector>

#include "dynamics/modal_model.hpp"
#include "dynamics/modal_table.hpp"
#include "identification/modal_fit.hpp"

namespace thinwall::identification {

/// The modes over all DOFs of responses and references, a row a mode, with
///
///     H = Σ R Lᵀ/(s − λ) + conj.,      L = φ and R = φ of a reciprocal mode
///
/// Where a DOF was measured in one of the two roles only, its entry in the other vector follows by reciprocity from the
/// DOFs that have both. Residues that are free become a row for each singular value above 1e-9 of the first. Throws
/// InputError where no DOF has both roles, which leaves the vectors without a scale. Cost O(modes DOFs²).
[[nodiscard]] dynamics::ModalTable modal_table(const ModalFit& fit, const dynamics::DofTable& responses,
                                               const dynamics::DofTable& forces);

/// modal_table() as a modal model with the constant term c_0 as its residual, where it was measured; the other residual
/// terms have no place in it, so that a model for other stages is best fitted without them. Errors as modal_table().
[[nodiscard]] dynamics::ModalModel modal_model(const ModalFit& fit, const dynamics::DofTable& responses,
                                               const dynamics::DofTable& forces);

/// A mode at one point as a mass on a spring along a line: the nearest real, symmetric one.
struct PointMode {
  double mass_kg = 0.0;        ///< for a motion of 1 along the line
  double stiffness_N_m = 0.0;  ///< ω² times it
  Eigen::VectorXd direction;   ///< of length 1, over the DOFs that have both roles
};

/// The modes at the DOFs that are both response and reference: with A = 2iω_d R there, the largest eigenvalue of the
/// symmetric part of Re A is 1/m, its eigenvector the line. None where it is not positive, as of no passive structure,
/// or where no DOF has both roles.
[[nodiscard]] std::vector<std::optional<PointMode>> point_modes(const ModalFit& fit,
                                                                const dynamics::DofTable& responses,
                                                                const dynamics::DofTable& forces);

/// Numbers of the DOFs that have both roles, as response and as reference.
struct CommonDofs {
  std::vector<int> response, reference;
};

/// The DOFs with both roles, by name, in the order of the responses.
[[nodiscard]] CommonDofs common_dofs(const dynamics::DofTable& responses, const dynamics::DofTable& forces);

}  // namespace thinwall::identification

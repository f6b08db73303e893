#pragma once
// Craig-Bampton models with a reduced interface.

#include <Eigen/Core>

#include "reduction/methods/craig_bampton.hpp"

namespace thinwall::reduction {

/// A Craig-Bampton model whose interface displacements follow from a few amplitudes, x = ψ a.
struct [[nodiscard]] CharacteristicModel {
  dynamics::SpatialModel model;
  Eigen::MatrixXd psi;           ///< interface × kept
  Eigen::VectorXd frequency_hz;  ///< frequencies of the kept modes; 0 for rigid-body motions
};

/// The model reduced to characteristic constraint modes (Castanier, Tan & Pierre 2001; docs/theory/reductions.md, Eq.
/// 4), which are the modes of the statically condensed part at its interface,
///
///     K_bb ψ = λ M_bb ψ,   ψᵀ M_bb ψ = I,   x = ψ a,   M = [ I  ψᵀM_bη ; …  I ],   K = diag(λ, ω²)
///
/// in the coordinates (a, η). It is meant for an interface of many DOFs that move together, such as a line or a face.
/// The DOFs are the interface, then "characteristic 1" …, then "mode 1" …; the coordinates differ from the DOFs.
/// `modes`: the number of the lowest modes kept; with as many as the interface has DOFs, the model is equivalent.
/// Throws InputError unless 1 ≤ modes ≤ interface DOFs. Cost O(interface³).
CharacteristicModel characteristic_constraint_modes(const CraigBampton& reduced, int modes);

}  // namespace thinwall::reduction

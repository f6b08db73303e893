#pragma once
// Craig-Bampton with a reduced interface.

#include <Eigen/Core>

#include "reduction/methods/craig_bampton.hpp"

namespace thinwall::reduction {

/// A Craig-Bampton model whose interface follows from few amplitudes, x = ψ a.
struct [[nodiscard]] CharacteristicModel {
  dynamics::SpatialModel model;
  Eigen::MatrixXd psi;           ///< interface × kept
  Eigen::VectorXd frequency_hz;  ///< of the kept characteristic constraint modes; 0 for rigid-body motions
};

/// Characteristic constraint modes (Castanier, Tan & Pierre 2001; docs/theory/reductions.md, Eq. 4): modes of
/// the interface as the statically condensed part moves it,
///
///     K_bb ψ = λ M_bb ψ,   ψᵀ M_bb ψ = I,   x = ψ a,   M = [ I  ψᵀM_bη ; …  I ],   K = diag(λ, ω²)
///
/// in the coordinates (a, η). For an interface of many DOFs that move together, a line or a face. DOFs: the interface,
/// then "characteristic 1" …, then "mode 1" …; the model has coordinates of its own. `modes`: the lowest so many. With
/// as many as the interface has DOFs nothing is lost. Throws InputError unless 1 ≤ modes ≤ interface DOFs. Cost
/// O(interface³).
CharacteristicModel characteristic_constraint_modes(const CraigBampton& reduced, int modes);

}  // namespace thinwall::reduction

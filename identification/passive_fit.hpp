#pragma once
// A fit that gives no energy at its driving points.

#include <Eigen/Core>

#include "dynamics/dof.hpp"
#include "identification/modal_fit.hpp"

namespace thinwall::identification {

/// The change that made a fit passive.
struct PassiveChange {
  double before = 0.0;  ///< the largest eigenvalue of A over ‖B‖ at a line, as it was; 0 where none is positive
  double after = 0.0;   ///< that of the fit returned
  double moved = 0.0;   ///< the largest |δR|/|R| of a mode, Frobenius norms at the driving points
  double chi2_before = 0.0;  ///< χ² of the fit as it was
};

/// The fit with other residues.
struct PassiveFit {
  ModalFit fit;  ///< its χ² is still that of the fit before
  PassiveChange change{};
};

/// The fit with residues that are moved as little as passivity at the driving points needs. With B the receptances
/// between them, A = (B − Bᴴ)/(2i) must not have a positive eigenvalue at any line, nor beside a resonance. Residues
/// move by first-order steps: at each local maximum of the largest eigenvalue, of vector v,
///
///     vᴴ A v + Im vᴴ [δR/(s − λ) + conj(δR)/(s − λ*)] v ≤ 0,        least Σ |δH|²/variance
///
/// (fast residue perturbation; Gustavsen 2008), a quadratic problem of few constraints, by Hildreth's method (1957),
/// until none is violated. The sum, over lines and entries, is taken as that of each unknown alone. Residues of rank
/// one stay so: their vectors move, and both by one change where `form` says that they are symmetric. Poles and terms
/// stay. The fit comes back as it was where it is passive, or has no driving point. Cost O(steps · lines · points³).
[[nodiscard]] PassiveFit made_passive(const ModalFit& fit, const MeasuredLines& measured,
                                      const dynamics::DofTable& responses, const dynamics::DofTable& forces,
                                      Residues form);

}  // namespace thinwall::identification

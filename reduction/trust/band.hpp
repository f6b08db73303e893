#pragma once
// A frequency band, and how far two receptances are apart in it.

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "dynamics/dof.hpp"
#include "reduction/full_model.hpp"
#include "reduction/methods/reduce.hpp"
#include "reduction/trust/receptance_sum.hpp"

namespace thinwall::reduction {

/// Where receptances are compared. A small structural damping keeps resonances finite: with the loss factor η every
/// model's stiffness is K (1 + iη), and its receptance follows from the undamped one (docs/theory/reductions.md, Eq. 2)
///
///     Wᵀ (K (1 + iη) − ω²M)⁻¹ W = H(z) / (1 + iη),    z = ω²/(1 + iη)
///
/// so that full and reduced models are damped alike whatever their coordinates.
struct Band {
  double from_hz = 0.0;  ///< ≥ 0; above 0 for a free part, which has no static receptance
  double to_hz = 0.0;    ///< > from_hz
  int lines = 200;  ///< ≥ 2, evenly in the logarithm (from to_hz/1000 where from_hz is 0), natural frequencies added
  double loss_factor = 0.02;  ///< η > 0, twice the damping ratio: ζ = 1 %
};

/// Throws InputError with every violation at once.
void validate(const Band& band);

/// The same, and InputError for a free part's band that begins at 0.
void validate(const Band& band, const FullModel& full);

/// z = ω²/(1 + iη) at every line: `lines` of them, each frequency of `natural_hz` in the band and its half-power points
/// f (1 ± η/2), ascending; in between the receptance is smooth.
[[nodiscard]] std::vector<std::complex<double>> squares(const Band& band, const Eigen::VectorXd& natural_hz);

/// Frequency of such a square, Hz.
[[nodiscard]] double frequency_hz(const Band& band, std::complex<double> z);

/// H(z) of a reduced model at its first `interface` DOFs. Cost O(n³) of a spatial, O(poles · interface²) of a modal
/// model. Throws NumericalError where K − zM is singular.
[[nodiscard]] Eigen::MatrixXcd receptance_at(const ReducedModel& model, Eigen::Index interface, std::complex<double> z);

/// Factors, a DOF each, that bring rotations to the size of translations: 1 for translations, √(max|H_tt|/max|H_rr|)
/// over all lines for rotations; all 1 if there are no translations.
[[nodiscard]] Eigen::VectorXd common_units(const dynamics::DofTable& interface, const std::vector<Eigen::MatrixXcd>& H);

/// The error of Eq. 13, max|s_i (H − H_full)_ij s_j| / max|s_i H_full,ij s_j| at one line: what a coupling, which
/// inverts sums of receptances, and lobes feel, at antiresonances as at resonances.
[[nodiscard]] double relative_error(const Eigen::MatrixXcd& H, const Eigen::MatrixXcd& full,
                                    const Eigen::VectorXd& units);

/// The full model over a band.
struct [[nodiscard]] BandTruth {
  Eigen::VectorXd natural_hz;  ///< elastic, up to to_hz
  int rigid_motions = 0;
  std::vector<std::complex<double>> z;
  std::vector<Eigen::MatrixXcd> H;  ///< H(z), interface × interface
  Eigen::VectorXd units;
  double max_relative_residual = 0.0;  ///< of receptance_sum()
};

/// Every mode up to the band's end and the Krylov rest (receptance_sum.hpp), so no reduction. Errors as validate(),
/// StaticFlexibility and receptance_sum(). Cost: a factorisation, the eigen-solution, some ten solves of interface-many
/// right-hand sides.
BandTruth band_truth(const FullModel& full, const Interface& interface, const Band& band);

/// The largest relative_error() of a reduced model over the lines of a truth; NaN if one is.
[[nodiscard]] double max_receptance_error(const ReducedModel& model, const BandTruth& truth);

}  // namespace thinwall::reduction

#pragma once
// A frequency band, and the difference of receptances in it.

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "dynamics/dof.hpp"
#include "reduction/full_model.hpp"
#include "reduction/methods/reduce.hpp"
#include "reduction/trust/receptance_sum.hpp"

namespace thinwall::reduction {

/// The band in which receptances are compared. A small structural damping keeps resonances finite: with the loss factor
/// η the stiffness of every model is K (1 + iη), and its receptance follows from the undamped one
/// (docs/theory/reductions.md, Eq. 2),
///
///     Wᵀ (K (1 + iη) − ω²M)⁻¹ W = H(z) / (1 + iη),    z = ω²/(1 + iη)
///
/// so that full and reduced models have the same damping whatever their coordinates.
struct Band {
  double from_hz = 0.0;       ///< ≥ 0; above 0 for a free part, which has no static receptance
  double to_hz = 0.0;         ///< > from_hz
  int lines = 200;            ///< ≥ 2, evenly spaced in the logarithm (from to_hz/1000 if from_hz is 0)
  double loss_factor = 0.02;  ///< η > 0, twice the damping ratio: ζ = 1 %
};

/// Throws InputError that lists every violation of the bounds above.
void validate(const Band& band);

/// Throws InputError that lists every violation of the bounds above, and for a band that begins at 0 if the part is
/// free.
void validate(const Band& band, const FullModel& full);

/// The values z = ω²/(1 + iη) at every line, ascending: the band's `lines`, and each frequency of `natural_hz` in the
/// band with its half-power points f (1 ± η/2), between which the receptance is smooth.
[[nodiscard]] std::vector<std::complex<double>> squares(const Band& band, const Eigen::VectorXd& natural_hz);

/// The frequency (Hz) of a value z of squares().
[[nodiscard]] double frequency_hz(const Band& band, std::complex<double> z);

/// The receptance H(z) of a reduced model at its first `interface` DOFs. Throws NumericalError if K − zM is singular.
/// Cost O(n³) for a spatial model, O(poles · interface²) for a modal one.
[[nodiscard]] Eigen::MatrixXcd receptance_at(const ReducedModel& model, Eigen::Index interface, std::complex<double> z);

/// A factor for each DOF that brings rotations to the size of translations: 1 for translations, √(max|H_tt|/max|H_rr|)
/// over all lines for rotations; all are 1 if there are no translations.
[[nodiscard]] Eigen::VectorXd common_units(const dynamics::DofTable& interface, const std::vector<Eigen::MatrixXcd>& H);

/// The relative error max|s_i (H − H_full)_ij s_j| / max|s_i H_full,ij s_j| at one line (docs/theory/reductions.md, Eq.
/// 13). It is relative to the largest entry and not to each entry, because a coupling inverts sums of receptances: this
/// is the error that couplings and lobes see, at antiresonances as at resonances.
[[nodiscard]] double relative_error(const Eigen::MatrixXcd& H, const Eigen::MatrixXcd& full,
                                    const Eigen::VectorXd& units);

/// The receptances of the full model over a band.
struct [[nodiscard]] BandTruth {
  Eigen::VectorXd natural_hz;  ///< elastic natural frequencies up to to_hz
  int rigid_motions = 0;
  std::vector<std::complex<double>> z;
  std::vector<Eigen::MatrixXcd> H;  ///< H(z), interface × interface
  Eigen::VectorXd units;
  double max_relative_error = 0.0;  ///< that of receptance_sum()
};

/// The receptances of the full model over a band, without reduction: every mode up to the band's end, and the rest of
/// the model from a Krylov space (receptance_sum.hpp). Throws as validate(), StaticFlexibility and receptance_sum() do.
/// Cost: a factorisation, the eigen-solution, about ten solves of interface-many right-hand sides.
BandTruth band_truth(const FullModel& full, const Interface& interface, const Band& band);

/// The largest relative_error() of a reduced model over the lines of a truth; NaN if one is.
[[nodiscard]] double max_receptance_error(const ReducedModel& model, const BandTruth& truth);

}  // namespace thinwall::reduction

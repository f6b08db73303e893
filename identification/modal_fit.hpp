#pragma once
// Poles and residues of measured receptances by least squares, started from poles that are nearly right.

#include <Eigen/Core>
#include <complex>
#include <string>
#include <vector>

#include "identification/measured_lines.hpp"

namespace thinwall::identification {

/// The stand-ins for modes outside of the band, real matrices a power: LR/s² below it, c_0 + c_1 s + … above. The
/// usual pair LR/s² + c_0 is biased beside heavily damped modes above the band; c_1 s takes most of that.
struct ResidualTerms {
  bool inertia = true;    ///< LR/s², free motion and modes below the band
  int highest_power = 1;  ///< of s, −1 to 6: −1 for none
};

/// The terms of a word: "none", "constant" (c_0 alone, for a model that other stages take), or the highest power of s,
/// "0" to "6", beside LR/s². Throws InputError for another one.
[[nodiscard]] ResidualTerms terms_named(const std::string& word);

/// The form of the residues.
enum class Residues {
  free,       ///< any matrix
  rank_one,   ///< R Lᵀ, responses and references each with a vector of their own (Lei 2022, Eq. 15-17)
  symmetric,  ///< rank one with L = R up to a factor, for references at the responses of the same number
};

/// The model and the search.
struct ModalFitOptions {
  ResidualTerms terms;
  Residues residues = Residues::rank_one;
  int most_steps = 60;
  bool coarse = false;  ///< ends where χ² falls by less than 1e-8 of itself, to compare models
};

/// A mode with its uncertainty: standard deviations to first order, from the variances of the lines.
struct FittedMode {
  double frequency_hz = 0.0;  ///< |λ|/2π
  double damping_ratio = 0.0;
  double sd_ln_frequency = 0.0;
  double sd_ln_damping = 0.0;
  Eigen::MatrixXcd residue;      ///< responses × references, m/(N s)
  Eigen::VectorXcd right;        ///< residue = right leftᵀ; empty for free residues
  Eigen::VectorXcd left;         ///< its largest entry is 1
  double second_singular = 0.0;  ///< σ₂/σ₁ of the free residue: how far it is from rank one

  /// λ, rad/s, Im > 0.
  [[nodiscard]] std::complex<double> pole() const;
};

/// The fit.
struct ModalFit {
  std::vector<FittedMode> modes;        ///< by rising frequency
  Eigen::MatrixXd inertia;              ///< LR, 1/kg; empty without
  std::vector<Eigen::MatrixXd> powers;  ///< c_0, c_1 …, m/N s^p
  double chi2 = 0.0;                    ///< weighted sum of squares
  double degrees_of_freedom = 0.0;      ///< numbers less unknowns
  Eigen::MatrixXd covariance;           ///< of all ln ω, then all ln ζ
  bool converged = false;

  /// 1 where the model and the variances are right, to within √(2/degrees of freedom).
  [[nodiscard]] double chi2_per_dof() const { return chi2 / degrees_of_freedom; }
};

/// Minimises Σ |H − model|² / variance over the lines, with
///
///     model = Σ_r [ R_r/(s − λ_r) + conj(R_r)/(s − λ_r*) ] + LR/s² + Σ_p c_p s^p,       s = iω,
///
/// by variable projection (Golub & Pereyra 1973, with the Jacobian of Kaufman 1975): only ln ω_r, ln ζ_r and the left
/// vectors are unknowns of the search (Levenberg 1944, Marquardt 1963), residues and residual terms follow by linear
/// least squares at each step. So poles are stable whatever the data, and nothing but `start` (rad/s) has to be
/// guessed. Forms other than free start from the free residues' singular vectors. Throws InputError as
/// require_usable(), without a pole, for a pole without Im > 0 and Re < 0, fewer numbers than unknowns, or symmetric
/// residues of a matrix that is not square. Cost: steps × entries × lines × (4 modes + terms)².
[[nodiscard]] ModalFit modal_fit(const MeasuredLines& measured, const Eigen::VectorXcd& start,
                                 const ModalFitOptions& options = {});

/// The poles of the modes, rad/s, Im > 0.
[[nodiscard]] Eigen::VectorXcd poles_of(const ModalFit& fit);

/// The model at a line, responses × references, m/N.
[[nodiscard]] Eigen::MatrixXcd value(const ModalFit& fit, double hz);

}  // namespace thinwall::identification

#pragma once
// One crossing of the unit circle, brought to its depth and angle by Newton's rule.

#include <Eigen/Core>
#include <complex>
#include <functional>
#include <numbers>
#include <optional>
#include <vector>

namespace thinwall::milling {

/// The loop's gain Z(e^{iθ}) at one speed, 0 ≤ θ ≤ π, however it was come by: from modes (loop_gain) or from a
/// receptance.
struct GainOnCircle {
  Eigen::Index size = 0;                                ///< contacts
  std::function<Eigen::MatrixXcd(double theta_rad)> Z;  ///< contacts × contacts, real at 0 and π
  /// lᵀ (dZ/dθ) r, for the two vectors that follow the angle: as a number it takes products of vectors only, while the
  /// matrix dZ/dθ would cost as much as Z.
  std::function<std::complex<double>(double theta_rad, const Eigen::VectorXcd& l, const Eigen::VectorXcd& r)> slope;
  std::vector<double> stops;  ///< angles in ascending order, 0 to π, between which Z changes moderately
};

/// A multiplier e^{iθ} that leaves or enters the unit circle as the depth rises.
struct Crossing {
  double depth_m = 0.0;
  double theta_rad = 0.0;   ///< arg μ, 0 to π
  int unstable_change = 0;  ///< multipliers that leave the circle: +2, −2 (Hopf), +1, −1 (flip, fold)
  Eigen::VectorXcd mode;    ///< c, the contacts' modulation of the motion, up to a factor
  std::optional<std::complex<double>> by_depth = {};  ///< ∂ν/∂w at this angle, as far as the depth shapes the cut and
                                                      ///< as it was last found; m⁻²
};

/// An eigenvalue ν of −Z(e^{iθ}), its vectors on both sides and its change along the circle.
struct Eigenpair {
  std::complex<double> nu;
  std::complex<double> slope;  ///< dν/dθ = −lᵀ (dZ/dθ) r / lᵀ r
  Eigen::VectorXcd right, left;
};

/// The eigenvalue nearest to a guess at a fixed angle, by inverse iterations on both sides. Throws NumericalError if
/// they do not converge. Cost: a factorisation of the size of Z, more where the guess is no better than the distance to
/// the next eigenvalue.
[[nodiscard]] Eigenpair eigenpair_near(const GainOnCircle& gain, double theta_rad, std::complex<double> guess);

/// The eigenvalue −lᵀ Z r / lᵀ r that the vectors of a pair give of a gain near by with the same contacts, exact to
/// first order in the change of Z; of that change alone, it is the change of ν.
[[nodiscard]] std::complex<double> rayleigh_quotient(const Eigenpair& pair, const Eigen::MatrixXcd& Z);

/// Brings a crossing to the axis: on the boundary det(I + w Z(e^{iθ})) = 0, so that 1/w is a real positive eigenvalue
/// ν(θ) of −Z. With its vectors l and r on both sides, from inverse iterations,
///
///     ν = −lᵀ Z r / lᵀ r,      dν/dθ = −lᵀ (dZ/dθ) r / lᵀ r
///
/// and Newton's rule leads to Im ν = 0, cubically with the vectors. A multiplier leaves the circle as the depth rises
/// where Im dν/dθ < 0, for with μ = e^{iθ}, ν(μ) = 1/w,
///
///     d|μ|/dw = −(1/w²) Im(dν/dθ) / |dν/dθ|²
///
/// `nu` is the guess of the eigenvalue at crossing.theta_rad. At θ = π (and 0) the angle stays: ν is real there. False
/// if it does not settle at a positive depth, or as soon as a step leads further than `furthest_rad` from where it
/// began. Cost: some four factorisations of the size of Z.
[[nodiscard]] bool to_axis(const GainOnCircle& gain, std::complex<double> nu, Crossing& crossing,
                           double furthest_rad = std::numbers::pi);

/// Moves a crossing to where it lies on another gain (finer nodes), or a guess with any unstable_change to a crossing.
/// False if it does not settle within a tenth of the depth.
[[nodiscard]] bool refine(const GainOnCircle& gain, Crossing& crossing);

}  // namespace thinwall::milling

#pragma once
// All depths at which a multiplier crosses the unit circle at one speed, directly: no search over depths.

#include <Eigen/Core>
#include <complex>
#include <functional>
#include <vector>

namespace thinwall::milling {

/// The loop's gain Z(e^{iθ}) at one speed, 0 ≤ θ ≤ π, however it was come by: from modes (loop_gain) or from a
/// receptance.
struct GainOnCircle {
  std::function<Eigen::MatrixXcd(double theta_rad)> Z;  ///< contacts × contacts, real at 0 and π
  std::vector<double> stops;  ///< angles in ascending order, 0 to π, between which Z changes moderately
};

/// A multiplier e^{iθ} that leaves or enters the unit circle as the depth rises.
struct Crossing {
  double depth_m = 0.0;
  double theta_rad = 0.0;   ///< arg μ, 0 to π
  int unstable_change = 0;  ///< multipliers that leave the circle: +2, −2 (Hopf), +1, −1 (flip, fold)
  Eigen::VectorXcd mode;    ///< c, the contacts' modulation of the motion, up to a factor
};

/// On the boundary det(I + w Z(e^{iθ})) = 0: the depths are the reciprocals of real positive eigenvalues ν of
/// −Z(e^{iθ}) as θ runs over the half circle. The eigenvalues are followed between stops; where the nearest match is
/// not clear or the path comes near the real axis the stop is halved. A path that crosses the axis is brought to it by
/// the secant rule on inverse iterations. At θ = π (and 0) real eigenvalues count as they are. Whether a multiplier
/// leaves follows from the slope alone: with μ = e^{iθ}, ν(μ) = 1/w,
///
///     d|μ|/dw = −(1/w²) Im(dν/dθ) / |dν/dθ|²
///
/// Depths from 0 to depth_limit_m (> 0), ascending. Throws NumericalError if an eigen-solution fails. Cost: some thirty
/// eigenvalue problems of the size of Z.
[[nodiscard]] std::vector<Crossing> critical_depths(const GainOnCircle& gain, double depth_limit_m);

/// The same crossing on another gain (finer nodes), or the one that a guess with unstable_change 0 leads to: secant
/// rule from where it was. False if it does not settle within a tenth of the depth.
[[nodiscard]] bool refine(const GainOnCircle& gain, Crossing& crossing);

/// Stops that Z needs with poles whose flow over a period is `flow` (e^{λT}): steps of at most 0.35 rad, and of 0.6 of
/// the distance to the nearest.
[[nodiscard]] std::vector<double> stops_between(const Eigen::VectorXcd& flow);

}  // namespace thinwall::milling

#pragma once
// Cutting coefficients from mean forces over the feed.

#include <Eigen/Core>
#include <vector>

#include "learning/linear_fit.hpp"
#include "milling/cut/cutting_force.hpp"
#include "milling/cut/engagement.hpp"

namespace thinwall::learning {

/// A cut whose mean force over a turn was measured.
struct MeanForceTest {
  milling::Engagement engagement;
  double depth_m = 0.0;                               ///< axial
  double feed_per_tooth_m = 0.0;                      ///< mean over the teeth
  Eigen::Vector3d force_n = Eigen::Vector3d::Zero();  ///< on the tool, tool axes: feed, normal, axis
};

/// The least-squares solution.
struct CoefficientFit {
  FittedCoefficient K_t, K_r, K_a, K_te, K_re, K_ae;
  double r_squared = 0.0;   ///< 1 − residual/scatter of the forces about their means, of all three directions
  double residual_n = 0.0;  ///< root mean square
  double condition = 1.0;   ///< of the equations across the axis, columns of one length
  Eigen::Index degrees_of_freedom = 0;  ///< across the axis
};

/// The mean of the linear force law (milling/cut/cutting_force.hpp) over a turn of z teeth, force on the tool,
///
///     F̄ = (z w/2π) ∫ [−(K_t t + K_r r − K_a z_T) c sin φ − (K_te t + K_re r − K_ae z_T)] dφ
///
/// from entry to exit with r = (sin φ, cos φ, 0), t = (cos φ, −sin φ, 0): exact of a cylinder with any helix, pitch and
/// runout as long as every tooth cuts (Budak, Altintas & Armarego 1996, Eq. 14). Tool axes, N.
[[nodiscard]] Eigen::Vector3d mean_force_n(int teeth, const milling::CuttingCoefficients& coefficients,
                                           const MeanForceTest& test);

/// The coefficients by linear least squares: K_t, K_r, K_te, K_re from the forces across the axis, K_a and K_ae from
/// those along it, each with the variance of its own residuals. With n = 2 N − 4 degrees of freedom (N − 2 along the
/// axis) the interval is t_{0.975, n} standard deviations; it is infinite where n = 0. Throws InputError for a bad
/// test, or where the tests do not tell the coefficients apart (a condition above 1e8), with the condition and the test
/// to add. Cost O(tests).
[[nodiscard]] CoefficientFit fit_mean_forces(int teeth, const std::vector<MeanForceTest>& tests);

}  // namespace thinwall::learning

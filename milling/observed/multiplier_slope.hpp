#pragma once
// The margin of a cut by its multipliers, and its derivatives by the uncertain parameters.

#include <Eigen/Core>
#include <vector>

#include "milling/chart/operating_point.hpp"
#include "milling/observed/uncertain_cut.hpp"

namespace thinwall::milling {

/// ln|μ| of the deciding multiplier on one grid, the frequency of its motion, the margin, and their derivatives by z.
struct MultiplierSlope {
  double margin = 0.0;  ///< ln|μ| / (T d), d the decay of the mode by decay_near(): −1 of a tool that does not cut, 0
                        ///< on the boundary, above 0 of chatter
  double log_modulus = 0.0;
  double frequency_hz = 0.0;
  double period_s = 0.0;        ///< after which the cut repeats itself
  Eigen::VectorXd margin_by_z;  ///< empty where it was not asked for
  Eigen::VectorXd log_modulus_by_z;
  Eigen::VectorXd frequency_by_z;  ///< Hz
};

/// 1/s: the decay rates of the poles, their geometric mean with weights |2πi f − λ|⁻², so that it is that of the pole
/// near f, and smooth between two. `poles` have some, all stable.
[[nodiscard]] double decay_near(const Eigen::VectorXcd& poles, double hz);

/// The multiplier that decides is the one of largest margin: the dominant one where that chatters, else a mode that
/// decays slowly and that the cut does not feel, of an arm or a floor, has the margin −1 and decides nothing. `poles`
/// are those by which margins are scaled, of the nominal structure, as many as it has and in its order.
///
/// The cut cut_at(nominal, parameters, z) at a point, on the grid that multiplier_at() would look at first and one half
/// as fine again, without its estimate. On that grid 1/w is an eigenvalue of −Z(μ) with vectors l and r (crossing.hpp),
/// also off the unit circle, so that
///
///     d ln μ / dz = −(lᵀ (∂Z/∂z) r) / (lᵀ (∂Z/∂ ln μ) r)
///
/// its real part the derivative of ln|μ|, its imaginary part over 2π T that of the frequency; ∂Z/∂z is a central
/// difference at fixed μ. Throws as multiplier_at(), and NumericalError if the vectors are not found. Cost: one
/// eigenvalue problem, and two loops for each parameter.
[[nodiscard]] MultiplierSlope multiplier_slope(const Cut& nominal, const std::vector<UncertainParameter>& parameters,
                                               const Eigen::VectorXd& z, const OperatingPoint& point,
                                               const Eigen::VectorXcd& poles, bool with_slopes);

}  // namespace thinwall::milling

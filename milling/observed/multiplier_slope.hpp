#pragma once
// The dominant multiplier of a cut and its derivatives by the uncertain parameters.

#include <Eigen/Core>
#include <vector>

#include "milling/chart/operating_point.hpp"
#include "milling/observed/uncertain_cut.hpp"

namespace thinwall::milling {

/// ln|μ| of the dominant multiplier on one grid, the frequency of its motion, and their derivatives by each z.
struct MultiplierSlope {
  double log_modulus = 0.0;
  double frequency_hz = 0.0;
  double period_s = 0.0;             ///< after which the cut repeats itself
  Eigen::VectorXd log_modulus_by_z;  ///< empty where it was not asked for
  Eigen::VectorXd frequency_by_z;    ///< Hz
};

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
                                               const Eigen::VectorXd& z, const OperatingPoint& point, bool with_slopes);

}  // namespace thinwall::milling

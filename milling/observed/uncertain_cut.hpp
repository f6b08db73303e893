#pragma once
// A structure and a process whose parameters are uncertain, as a function of independent standard normal numbers.

#include <Eigen/Core>
#include <random>
#include <string>
#include <vector>

#include "milling/chart/sensitivity.hpp"
#include "milling/cut/process.hpp"
#include "milling/structure/relative_structure.hpp"

namespace thinwall::milling {

/// The quantity that one uncertain parameter is; speed_exponent is that of Cut.
enum class ParameterOf { frequency, damping_ratio, mass, K_t, K_r, K_a, speed_exponent };

/// One uncertain parameter, p = p₀ e^{s z} with z standard normal: s is its relative standard uncertainty, to first
/// order, and p keeps its sign. The speed exponent is s z, of either sign.
struct UncertainParameter {
  ParameterOf of = ParameterOf::frequency;
  Eigen::Index mode = -1;  ///< number of its pole; −1 of a coefficient and of the speed exponent
  double spread = 0.0;     ///< s > 0
};

/// A structure and a process, whose coefficients fall with the spindle speed n as (n/n₀)^{−q}: a faster cut is hotter.
struct Cut {
  RelativeStructure structure;
  MillingProcess process;       ///< at n₀
  double speed_exponent = 0.0;  ///< q
  double reference_rpm = 1e4;   ///< n₀
};

/// The process of a cut at a spindle speed: K_t, K_r and K_a of every tooth times (n/n₀)^{−q}. Edge forces stay.
[[nodiscard]] MillingProcess process_at(const Cut& cut, double spindle_speed_rpm);

/// The parameters that `uncertainty` makes uncertain, mode by mode (frequency, damping ratio, modal mass), then K_t,
/// K_r and K_a; those of no uncertainty, the damping ratios of real poles, and coefficients that are 0, which a share
/// of themselves does not change, are left out. Throws InputError for a bad uncertainty.
[[nodiscard]] std::vector<UncertainParameter> uncertain_parameters(const Cut& cut, const Uncertainty& uncertainty);

/// The cut with every parameter at p₀ e^{s z}, one z for each; a damping ratio stays below 0.99. Throws InputError for
/// another number of z.
[[nodiscard]] Cut cut_at(const Cut& nominal, const std::vector<UncertainParameter>& parameters,
                         const Eigen::VectorXd& z);

/// The value of a parameter of the cut: Hz, 1, kg by the pole's own scaling (1 of the nominal cut), N/m², and q.
[[nodiscard]] double value_of(const Cut& nominal, const UncertainParameter& parameter, double z);

/// A vector of independent standard normal numbers (core/draws.hpp).
[[nodiscard]] Eigen::VectorXd standard_normal(Eigen::Index size, std::mt19937& random);

}  // namespace thinwall::milling

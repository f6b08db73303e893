#pragma once
// The probability that a cut chatters, where the structure and the coefficients are known with an uncertainty only.

#include <vector>

#include "milling/chart/operating_point.hpp"
#include "milling/observed/uncertain_cut.hpp"

namespace thinwall::milling {

/// The structures and processes of independent draws of the uncertain parameters, by one std::mt19937 of that seed.
/// Throws InputError for a bad uncertainty or if `count` is not positive.
[[nodiscard]] std::vector<Cut> drawn_cuts(const Cut& nominal, const Uncertainty& uncertainty, int count, unsigned seed);

/// The share of the draws with |μ| > 1 at each point. With n draws and a true probability p its standard error is
/// √(p (1 − p)/n). A multiplier counts whatever its estimate, for only its side of 1 matters. The points share out
/// among the threads; interruptible. Throws as multiplier_at(). Cost: points times draws multipliers.
[[nodiscard]] std::vector<double> chatter_probabilities(const std::vector<Cut>& draws,
                                                        const std::vector<OperatingPoint>& points,
                                                        const StabilityOptions& options);

}  // namespace thinwall::milling

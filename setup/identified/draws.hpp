#pragma once
// The number of draws by which the uncertainty of an identification goes on to charts.

namespace thinwall::setup {

/// Models that are drawn beside an identified one: with 100 of them the ends of a band of 95 % scatter by some 0.25
/// standard deviations.
inline constexpr int identified_draws = 100;

}  // namespace thinwall::setup

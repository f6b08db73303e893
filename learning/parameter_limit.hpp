#pragma once
// The most parameters that a calibration takes.

namespace thinwall::learning {

/// The quadratic margins (quadratic_cuts.hpp) take a number of predictions that grows with the square of the
/// parameters: 92 of them took minutes with two cuts, and a few dozen cuts do not tell as many apart.
constexpr int most_parameters = 24;

}  // namespace thinwall::learning

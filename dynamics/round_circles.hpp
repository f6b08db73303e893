#pragma once
// Lines that a response needs besides its own so that its resonances are drawn as the circles that they are.

#include <Eigen/Core>
#include <vector>

namespace thinwall::dynamics {

/// The middles of the steps on which some Nyquist curve turns by more than 20 degrees at a line, so that half a step is
/// up to 1.5 % of the radius off the circle of a resonance; ascending. Of the two steps at such a line both count if
/// neither is twice as long as the other, else the longer one. What is shorter than 0.3 % of the curve's largest
/// modulus is not seen and does not count; without damping there is no circle. `curves`: lines × entries, one entry of
/// a receptance a column. Called again with the values there it comes to an end, by a factor of two for each call. Cost
/// O(lines · entries).
[[nodiscard]] std::vector<double> lines_to_add(const Eigen::VectorXd& hz, const Eigen::MatrixXcd& curves);

}  // namespace thinwall::dynamics

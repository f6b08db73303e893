#pragma once
// The number of the lowest modes that are rigid-body motions or mechanisms.

#include <Eigen/Core>

namespace thinwall::reduction {

/// The largest number of modes that are taken for rigid ones: those of two free pieces.
constexpr int most_rigid_modes = 12;

/// The number of modes counted as free, and the highest of their frequencies. A suspension a thousand times softer than
/// the part is counted as free too; the frequency reveals it.
struct ModesWithoutEnergy {
  int count = 0;
  double highest_hz = 0.0;
};

/// The number of modes without energy: the largest k ≤ 12 with |λ_k| < max(1e-6 λ_{k+1}, round_off); the last λ has no
/// next one and is compared with round_off alone. lambda: ascending, finite, rad²/s²; round_off: that of the
/// eigen-solution, in the same unit, 0 if it is unknown. Cost O(1).
[[nodiscard]] int rigid_count(const Eigen::VectorXd& lambda, double round_off);

/// The number of modes without energy by rigid_count(), with the frequency √max |λ| / 2π of those counted.
[[nodiscard]] ModesWithoutEnergy without_energy(const Eigen::VectorXd& lambda, double round_off);

}  // namespace thinwall::reduction

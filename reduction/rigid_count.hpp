#pragma once
// How many of the lowest modes are rigid-body motions or mechanisms.

#include <Eigen/Core>

namespace thinwall::reduction {

/// No more modes than these are taken for rigid ones: two free pieces.
constexpr int most_rigid_modes = 12;

/// Modes that are counted as free, and how far from free they are: the frequency of the highest. A suspension a
/// thousand times softer than the part counts as none, and so shows.
struct ModesWithoutEnergy {
  int count = 0;
  double highest_hz = 0.0;
};

/// The count of modes without energy: the largest k ≤ 12 with |λ_k| < max(1e-6 λ_{k+1}, round_off); the last λ has no
/// next one and is held to round_off alone. lambda: ascending, finite, rad²/s²; round_off: of the eigen-solution, in
/// the same unit, 0 if nothing is known of it. Cost O(1).
[[nodiscard]] int rigid_count(const Eigen::VectorXd& lambda, double round_off);

/// The same with the frequency √max |λ| / 2π of those counted.
[[nodiscard]] ModesWithoutEnergy without_energy(const Eigen::VectorXd& lambda, double round_off);

}  // namespace thinwall::reduction

#pragma once
// Tables of a contact's stiffness and damping, measured under several preloads.

#include <Eigen/Core>

#include "coupling/contact.hpp"

namespace thinwall::coupling {

/// A table with one row for each preload: strictly rising preloads (N), stiffness (N/m, > 0), damping (N s/m, ≥ 0); at
/// least two rows.
struct ContactTable {
  Eigen::VectorXd preload;
  Eigen::VectorXd stiffness;
  Eigen::VectorXd damping;
};

/// Throws InputError that lists every violation: lengths that differ, fewer than two rows, preloads that do not rise, a
/// stiffness that is not positive, a negative damping, a value that is not finite.
void require_valid(const ContactTable& table);

/// The spring along `direction` under a preload (N), interpolated by monotone piecewise cubics through the rows
/// (Fritsch & Butland 1984: the slope at a row is the weighted harmonic mean of the adjacent secants, zero at a local
/// extreme), so that no value lies beyond those of the two adjacent rows. Throws InputError for a faulty table, or for
/// a preload outside of it, with its range.
[[nodiscard]] ContactSpring spring_at(const ContactTable& table, double preload,
                                      const Eigen::Vector3d& direction = Eigen::Vector3d::UnitX());

}  // namespace thinwall::coupling

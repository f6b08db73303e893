#pragma once
// A contact's stiffness and damping as they were measured under some preloads.

#include <Eigen/Core>

#include "coupling/contact.hpp"

namespace thinwall::coupling {

/// One row a preload: strictly rising preloads (N), stiffness (N/m, > 0), damping (N s/m, ≥ 0). Two rows or more.
struct ContactTable {
  Eigen::VectorXd preload;
  Eigen::VectorXd stiffness;
  Eigen::VectorXd damping;
};

/// Throws InputError with every violation at once: lengths that differ, fewer than two rows, preloads that do not rise,
/// a stiffness that is not positive, a negative damping, a value that is not finite.
void require_valid(const ContactTable& table);

/// The spring along `direction` under a preload, by monotone piecewise cubics through the rows (Fritsch & Butland 1984:
/// the slope at a row is the weighted harmonic mean of those beside it, zero at a local extreme): no value beyond those
/// of the two rows beside it. Throws InputError for a preload outside the table, with its range, or a faulty table.
[[nodiscard]] ContactSpring spring_at(const ContactTable& table, double preload,
                                      const Eigen::Vector3d& direction = Eigen::Vector3d::UnitX());

}  // namespace thinwall::coupling

#pragma once
// The motion of a structure under a force that repeats itself.

#include <Eigen/Core>

#include "milling/cut/contact_grid.hpp"
#include "milling/structure/relative_structure.hpp"

namespace thinwall::milling {

/// A moment of the period. The force jumps where a tooth enters or leaves: `element` tells the side.
struct Moment {
  double rotation_rad = 0.0;
  int element = -1;  ///< of the grid; −1: nothing cuts
};

/// The moment at a rotation, which is brought into the period.
[[nodiscard]] Moment moment_at(const ContactGrid& grid, double rotation_rad);

/// The value at a moment of what is known at the nodes (rows × nodes): the polynomial of the element, zero between
/// elements.
[[nodiscard]] Eigen::VectorXd at_moment(const ContactGrid& grid, const Eigen::MatrixXd& at_nodes, const Moment& moment);

/// The periodic motion of the modes z' = λ z + bᵀf, q = 2 Re Σ φ z + R f (a real pole once), under forces that are
/// polynomials between the nodes of an element and zero between elements:
///
///     z(0) = ∫₀ᵀ e^{λ(T−s)} bᵀf(s) ds / (1 − e^{λT})
///
/// The exponential is integrated against the polynomials as it is (product_rule.hpp), so that the motion is exact for
/// the force that the nodes stand for, however fast the mode. Keeps references to structure and grid.
struct PeriodicMotion {
  const RelativeStructure& structure;  ///< tool axes
  const ContactGrid& grid;
  double seconds_per_rad = 0.0;
  Eigen::MatrixXd force;         ///< at the nodes, on the tool, N, 3 × nodes
  Eigen::MatrixXcd modal_force;  ///< bᵀf, poles × nodes
  Eigen::VectorXcd at_start;     ///< z of each pole when the period begins
  Eigen::MatrixXcd at_from;      ///< and when each element does, poles × elements
  Eigen::MatrixXcd at_to;        ///< and ends
};

/// Cost O(poles elements nodes_of_an_element²).
[[nodiscard]] PeriodicMotion periodic_motion(const RelativeStructure& structure, const ContactGrid& grid,
                                             double spindle_speed_rpm, const Eigen::MatrixXd& force);

/// q of tool minus part, tool axes, m. Cost O(poles nodes_of_an_element²).
[[nodiscard]] Eigen::Vector3d displacement(const PeriodicMotion& motion, const Moment& moment);

/// The displacement at every node, 3 × nodes.
[[nodiscard]] Eigen::Matrix3Xd displacement_at_nodes(const PeriodicMotion& motion);

}  // namespace thinwall::milling

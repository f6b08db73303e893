#pragma once
// The structure as real first-order equations in the tool's axes: state, contact displacement, force.

#include <Eigen/Core>

#include "milling/cut/tool.hpp"
#include "milling/structure/relative_structure.hpp"

namespace thinwall::milling {

/// x' = Λ x + B f,  y = C x, with f the force on the tool in tool axes (3) and y the displacement in the plane of the
/// cut in the p ≤ 2 directions `in_plane` (2 × p, orthonormal columns) that the structure can move in: q = in_plane y.
///
/// States: real parts of all conjugate pairs, their imaginary parts, then the real poles. Each mode is scaled so that
/// its state is its contact displacement in m; state and displacement history then have one size, as the eigen-solver
/// likes.
struct ContactState {
  Eigen::ArrayXd decay;      ///< Re λ of the pairs, rad/s
  Eigen::ArrayXd frequency;  ///< Im λ of the pairs, rad/s
  Eigen::ArrayXd real_pole;  ///< real poles, rad/s
  Eigen::MatrixXd B;         ///< states × 3
  Eigen::MatrixXd C;         ///< p × states
  Eigen::Matrix3Xd motion;   ///< 3 × states: the displacement in tool axes, the axis included
  Eigen::Matrix2Xd in_plane;
  Eigen::VectorXd pair_force;   ///< states: B of a pair of forces elsewhere; empty without one
  Eigen::VectorXd pair_motion;  ///< states: the distance between its two points, m

  /// Number of states: two a pair of poles, one a real pole.
  [[nodiscard]] Eigen::Index size() const { return 2 * decay.size() + real_pole.size(); }
  /// Number of directions in which the structure yields.
  [[nodiscard]] Eigen::Index directions() const { return C.rows(); }
};

/// Throws InputError if the structure does not move in the plane of the cut. Cost O(poles).
[[nodiscard]] ContactState contact_state(const RelativeStructure& structure, const ToolFrame& frame);

/// As above, with a pair of forces on two other points of the structure. Throws InputError for another number of poles,
/// too.
[[nodiscard]] ContactState contact_state(const RelativeStructure& structure, const ForcePair& pair,
                                         const ToolFrame& frame);

/// Λ, states × states.
[[nodiscard]] Eigen::MatrixXd state_matrix(const ContactState& state);

/// e^{Λ t} in O(states).
struct FreeFlight {
  Eigen::ArrayXd cosine;  ///< e^{Re λ t} cos(Im λ t)
  Eigen::ArrayXd sine;
  Eigen::ArrayXd decay;  ///< e^{λ t} of the real poles
};

/// Over a time, s.
[[nodiscard]] FreeFlight free_flight(const ContactState& state, double time_s);

/// X ← e^{Λ t} X for every column of X (states × any).
void advance(const FreeFlight& flight, Eigen::Ref<Eigen::MatrixXd> X);

/// Largest |λ|, rad/s.
[[nodiscard]] double fastest_pole(const ContactState& state);

}  // namespace thinwall::milling

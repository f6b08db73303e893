#pragma once
// A robot's tip from a table of identified modes, not symmetric: what a measurement of all of it gives.

#include <Eigen/Core>
#include <string>

#include "dynamics/modal_model.hpp"
#include "dynamics/modal_table.hpp"

namespace thinwall::robot {

/// May a point of a table stand for two places? See modal_model().
enum class PointPlaces { one_each, may_differ };

/// With λ = ω_n (−ζ + i√(1 − ζ²)), ω_n = 2πf, each row is a pole and its conjugate (Lei, Hou & Ding 2022, Eq. 14-16):
///
///     H_jk(ω) = Σ R_j L_k / (iω − λ) + R̄_j L̄_k / (iω − λ̄)
///
/// so the scaling is one. H_jk ≠ H_kj in general, and nothing makes such a sum passive: Im H_jj may be positive between
/// modes. Throws InputError with every violation at once, row by row: a vector of another length than the table, a
/// frequency or damping ratio that is not positive, a ratio of one or more, a number that is not finite; and for a
/// point that lies at different places in different rows, which sums up motions of two points, unless `places` says
/// that they may differ. Cost O(rows · DOFs).
[[nodiscard]] dynamics::ModalModel modal_model(const dynamics::ModalTable& table,
                                               PointPlaces places = PointPlaces::one_each);

/// The same direct receptances and no others: every pole once a DOF, its vectors zero elsewhere. What one direction
/// measured without the other tells; to see what the cross terms do. Cost O(poles · DOFs²).
[[nodiscard]] dynamics::ModalModel without_cross_terms(const dynamics::ModalModel& model);

/// The table's part at one point, in rows and columns. That of the tip is always one point.
[[nodiscard]] dynamics::ModalTable at_point(const dynamics::ModalTable& table, const std::string& point);

/// The rows in which `point` lies `place` (m, to 1e-9) from the tip: the modes of one sensor. Throws InputError if
/// there is none, with the places that there are.
[[nodiscard]] dynamics::ModalTable with_point_at(const dynamics::ModalTable& table, const std::string& point,
                                                 double place);

/// The tip's translations and rotations from the points `tip` and `second`, the tool between them rigid and `up` (unit
/// vector) pointing from tip to spindle. With S the distance of the points in that very row,
///
///     R_θ = (R_a − R_1)/S,   L_θ = (L_a − L_1)/S     about up × d      for each direction d of both points
///
/// mode by mode, so that rows of different S agree on one tip. With one S these are finite differences (Lei, Hou & Ding
/// 2022, Appendix A, without its reciprocity, and in the sense of a rotation about up × d), H_θ1 = (H_a1 − H_11)/S and
/// the consistent second one, H_θθ = (H_11 − H_a1 − H_1a + H_aa)/S². What the vectors err by is divided by S. Throws
/// InputError unless both points have the same directions across `up`, and S > 0.
[[nodiscard]] dynamics::ModalTable with_rotations(const dynamics::ModalTable& table, const std::string& tip,
                                                  const std::string& second, const Eigen::Vector3d& up);

}  // namespace thinwall::robot

#pragma once
// A robot's tip from a table of identified modes, as a measurement in several directions gives; the receptance need not
// be symmetric.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "dynamics/modal_model.hpp"
#include "dynamics/modal_table.hpp"

namespace thinwall::robot {

/// The permission for a point of a table to be at different places in different modes; see modal_model().
enum class PointPlaces { one_each, may_differ };

/// The modal model of a table of modes. With λ = ω_n (−ζ + i√(1 − ζ²)), ω_n = 2πf, each row of the table gives a pole
/// and its conjugate (Lei, Hou & Ding 2022, Eq. 14-16):
///
///     H_jk(ω) = Σ R_j L_k / (iω − λ) + R̄_j L̄_k / (iω − λ̄)
///
/// so that the scaling is one. In general H_jk ≠ H_kj, and such a sum is not necessarily passive: Im H_jj may be
/// positive between modes. Throws InputError that lists every violation, row by row: a vector of another length than
/// the table, a frequency or damping ratio that is not positive, a ratio of one or more, a number that is not finite;
/// and for a point that lies at different places in different rows, because the sum would mix motions of two points,
/// unless `places` says that they may differ. Cost O(rows · DOFs).
[[nodiscard]] dynamics::ModalModel modal_model(const dynamics::ModalTable& table,
                                               PointPlaces places = PointPlaces::one_each);

/// The model with the direct receptances only: every pole is repeated for each DOF, with vectors that are zero
/// elsewhere. It is what one obtains by measuring each direction without the others, and shows the effect of the cross
/// terms. Cost O(poles · DOFs²).
[[nodiscard]] dynamics::ModalModel without_cross_terms(const dynamics::ModalModel& model);

/// The part of the table at one point, in rows and columns. For the tip, this is always at one place.
[[nodiscard]] dynamics::ModalTable at_point(const dynamics::ModalTable& table, const std::string& point);

/// The part of the table at some of its DOFs, in rows and columns.
[[nodiscard]] dynamics::ModalTable at_dofs(const dynamics::ModalTable& table, const std::vector<int>& dofs);

/// The rows in which `point` lies `place` (m, to 1e-9) from the tip, which are the modes of one sensor. Throws
/// InputError, with the places that occur, if there is none.
[[nodiscard]] dynamics::ModalTable with_point_at(const dynamics::ModalTable& table, const std::string& point,
                                                 double place);

/// The table with the tip's translations and rotations, from the points `tip` and `second`, if the tool between them is
/// rigid and `up` (unit vector) points from tip to spindle. With S the distance of the points in the row concerned,
///
///     R_θ = (R_a − R_1)/S,   L_θ = (L_a − L_1)/S     about up × d      for each direction d of both points
///
/// mode by mode, so that rows with different S describe one tip. If S is the same in all rows these are finite
/// differences (Lei, Hou & Ding 2022, Appendix A, without its reciprocity, and in the sense of a rotation about up ×
/// d), H_θ1 = (H_a1 − H_11)/S and the consistent second one, H_θθ = (H_11 − H_a1 − H_1a + H_aa)/S². Errors of the
/// vectors are divided by S. Throws InputError unless both points have the same directions across `up`, and S > 0.
[[nodiscard]] dynamics::ModalTable with_rotations(const dynamics::ModalTable& table, const std::string& tip,
                                                  const std::string& second, const Eigen::Vector3d& up);

}  // namespace thinwall::robot

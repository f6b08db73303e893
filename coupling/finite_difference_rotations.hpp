#pragma once
// Rotations at a tool's tip from displacements at two points, and what that costs.

#include <optional>
#include <string>
#include <vector>

#include "coupling/frf_noise.hpp"
#include "dynamics/beam_element.hpp"
#include "dynamics/response_model.hpp"

namespace thinwall::coupling {

/// Where a tool was hit and measured: at the tip (1) and at a distance S up the tool (1a), in the same directions.
struct DifferencePoints {
  std::string tip;
  std::string up;
  double distance_m = 0.0;                          ///< S > 0
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit vector from the tip to the spindle
  std::vector<Eigen::Vector3d> directions{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};  ///< at right angles to
                                                                                                ///< it, one or two
};

/// How P, the rotation by a moment, follows from both points.
enum class RotationRule {
  second_difference,  ///< P = (H_11 − H_a1 − H_1a + H_aa)/S²
  rank_one,           ///< P = N L / H_11, entry by entry (Lei 2022, Eq. A.9-A.12): H_aa is not used
  corrected,          ///< second_difference less its truncation, which asks for `tip_section`
};

/// Of finite_difference_rotations().
struct RotationOptions {
  RotationRule rule = RotationRule::second_difference;
  /// What the tool is like between both points, for the truncation.
  std::optional<dynamics::Tube> tip_section{};
  /// ≥ 0: how well that is known, relative, of its flexibility and mass: a share of the truncation.
  double section_uncertainty = 0.1;
  Deviations noise{};  ///< of the FRFs given; empty: none
};

/// What the entries of a tip's receptance are off by, one matrix a line, in their order and units.
struct RotationErrors {
  std::vector<Eigen::MatrixXcd> truncation;  ///< estimate of T − true, signed; 0 if `corrected`; empty: not known
  std::vector<Eigen::MatrixXd> truncation_uncertainty;  ///< what that estimate may be off by itself; as long
  std::vector<Eigen::MatrixXd> rank_one;  ///< |P by rank one − P by second difference| in the entries of P
  std::vector<Eigen::MatrixXd> noise;     ///< standard deviation of real and imaginary part, first order; empty: none
};

/// What finite_difference_rotations() makes of the displacements.
struct TipReceptance {
  dynamics::ResponseModel T;  ///< DOFs: for each direction the displacement, then the rotation
  RotationErrors errors;
};

/// T_11 of a tool's tip from displacement FRFs, 4 × 4 from the 16 of Lei 2022, Eq. 5, with two directions. The slope
/// du/ds of the displacement along e, s from the tip along the axis d, is the rotation about d × e (d = z: of u_x about
/// +y, of u_y about −x); the DOFs are named after the axis that is positive, "tip.ry" and "tip.rx" with u_y' = −rx.
/// With ± for that sign and rows a, columns 1 meaning "displacement at 1a by a force at 1" (Eq. A.1-A.8)
///
///     N = ±(H_a1 − H_11)/S,   L = ±(H_1a − H_11)/S,   P = ±±(H_11 − H_a1 − H_1a + H_aa)/S²
///
/// which is T = Q H Qᵀ with one Q a direction, [1 0; ∓1/S ±1/S]. Eq. A.9-A.12 are P = N L/H instead, right where one
/// mode stands alone: H_ij = φ_i φ_j/(…); P is 0 there where N, L and H are.
///
/// Truncation. Differences give the mean of the *displacement's* slope over S, which also bears the bending within S
/// and the shear, u' = ψ + γ. With EI, κGA, ρA, ρI of the tool there, a unit force or moment at the tip, leading terms,
///
///     c_F = S²/6EI − 1/κGA,   c_M = −S/2EI,   c_u = ω²ρA (S³/24EI − S/2κGA),
///     c_ψ = ω²ρA (S⁴/120EI − S²/6κGA) − ω²ρI S²/6EI
///     δN = ±(c_F I + c_u H) + c_ψ N,   δL alike,   δP = (c_M − c_F/S) I + c_u (±N ± L) + 2 c_ψ P
///
/// (I: force and rotation of one direction). δP = −2S/3EI + 1/(κGA S) + …: it does not fall with S where shear matters.
/// taken at T less these terms once; by how much that changes them adds to their uncertainty. Derivation and what it
/// costs: docs/theory/tool-swap.md. Without `tip_section` the truncation stays unknown unless a second distance tells
/// (truncation_by_distance()).
///
/// Throws InputError with every violation at once: S = 0 or not positive, an axis or direction that is none, FRFs that
/// are missing (each named), a value that is not finite, a section that is none, `corrected` without one, noise of
/// another shape. Throws NumericalError, with the frequency, where rank one divides by H = 0. Cost O(lines).
[[nodiscard]] TipReceptance finite_difference_rotations(const dynamics::ResponseModel& displacements,
                                                        const DifferencePoints& points,
                                                        const RotationOptions& options = {});

/// Richardson's estimate of the truncation of `near`, T(S₁) − true ≈ (T(S₂) − T(S₁)) S₁/(S₂ − S₁), from the same tip at
/// a larger distance: of what falls in proportion to S. What does not (c_F and 1/κGAS above) is not seen. Throws
/// InputError unless both have the same axis and DOFs and 0 < S₁ < S₂.
[[nodiscard]] std::vector<Eigen::MatrixXcd> truncation_by_distance(const dynamics::ResponseModel& near,
                                                                   double near_distance_m,
                                                                   const dynamics::ResponseModel& far,
                                                                   double far_distance_m);

/// |truncation| + its uncertainty + |rank one| + k noise, one matrix a line: an entry is off by no more with the
/// confidence of k standard deviations (the modulus of the noise exceeds k σ with probability e^{−k²/2}). The rank-one
/// part counts where the rule was `rank_one`. Throws InputError where the truncation is not known, or unless k ≥ 0.
[[nodiscard]] std::vector<Eigen::MatrixXd> error_bound(const RotationErrors& errors, RotationRule rule, double k);

}  // namespace thinwall::coupling

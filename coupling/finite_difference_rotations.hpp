#pragma once
// Rotations at a tool's tip by finite differences of displacements at two points, with their errors.

#include <optional>
#include <string>
#include <vector>

#include "coupling/frf_noise.hpp"
#include "dynamics/beam_element.hpp"
#include "dynamics/response_model.hpp"

namespace thinwall::coupling {

/// The points where a tool was excited and measured: the tip (1) and a point at a distance S up the tool (1a), in the
/// same directions.
struct DifferencePoints {
  std::string tip;
  std::string up;
  double distance_m = 0.0;                          ///< S > 0
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit vector from the tip to the spindle
  /// One or two directions at right angles to the axis.
  std::vector<Eigen::Vector3d> directions{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
};

/// The rule by which P, the rotation due to a moment, follows from both points.
enum class RotationRule {
  second_difference,  ///< P = (H_11 − H_a1 − H_1a + H_aa)/S²
  rank_one,           ///< P = N L / H_11, entry by entry (Lei 2022, Eq. A.9-A.12), without H_aa
  corrected,          ///< second_difference less its truncation; requires `tip_section`
};

/// Options of finite_difference_rotations().
struct RotationOptions {
  RotationRule rule = RotationRule::second_difference;
  /// The section of the tool between both points, for the truncation.
  std::optional<dynamics::Tube> tip_section{};
  /// The relative uncertainty (≥ 0) of the flexibility and mass of that section, which is the same share of the
  /// truncation.
  double section_uncertainty = 0.1;
  Deviations noise{};  ///< deviations of the FRFs given; empty if none
};

/// The errors of the entries of a tip's receptance, one matrix for each line, in their order and units.
struct RotationErrors {
  std::vector<Eigen::MatrixXcd> truncation;  ///< estimate of T − true, signed; 0 if `corrected`; empty if unknown
  std::vector<Eigen::MatrixXd> truncation_uncertainty;  ///< uncertainty of that estimate, as many lines
  std::vector<Eigen::MatrixXd> rank_one;  ///< |P by rank one − P by second difference| in the entries of P
  std::vector<Eigen::MatrixXd> noise;     ///< deviation of real and imaginary part, first order; may be empty
};

/// The receptance that finite_difference_rotations() finds, and its errors.
struct TipReceptance {
  dynamics::ResponseModel T;  ///< DOFs: for each direction the displacement, then the rotation
  RotationErrors errors;
};

/// The receptance T_11 of a tool's tip with rotations, from displacement FRFs: with two directions it is 4 × 4, from
/// the 16 FRFs of Lei 2022, Eq. 5. The slope du/ds of the displacement along e, with s measured from the tip along the
/// axis d, is the rotation about d × e (for d = z: that of u_x about +y, that of u_y about −x); the DOFs are named
/// after the positive axis, "tip.ry" and "tip.rx" with u_y' = −rx. With ± for that sign, and H_a1 the displacement at
/// 1a due to a force at 1 (Eq. A.1-A.8),
///
///     N = ±(H_a1 − H_11)/S,   L = ±(H_1a − H_11)/S,   P = ±±(H_11 − H_a1 − H_1a + H_aa)/S²
///
/// which is T = Q H Qᵀ with Q = [1 0; ∓1/S ±1/S] for each direction. Eq. A.9-A.12 take P = N L/H instead, which is
/// right if a single mode dominates, H_ij = φ_i φ_j/(…); P is taken as 0 if N, L and H are all 0.
///
/// Truncation: differences give the mean slope of the *displacement* over S, which includes the bending within S and
/// the shear, u' = ψ + γ. With EI, κGA, ρA, ρI of the tool there and a unit force or moment at the tip, the leading
/// terms of the error are
///
///     c_F = S²/6EI − 1/κGA,   c_M = −S/2EI,   c_u = ω²ρA (S³/24EI − S/2κGA),
///     c_ψ = ω²ρA (S⁴/120EI − S²/6κGA) − ω²ρI S²/6EI
///     δN = ±(c_F I + c_u H) + c_ψ N,   δL alike,   δP = (c_M − c_F/S) I + c_u (±N ± L) + 2 c_ψ P
///
/// (I is 1 for a force and a rotation of the same direction, else 0). δP = −2S/3EI + 1/(κGA S) + … does not fall with S
/// where shear matters. The terms are evaluated at T less the terms themselves, once; the change that this makes adds
/// to their uncertainty. Derivation and measurements: docs/theory/tool-swap.md. Without `tip_section` the truncation is
/// unknown, unless a second distance gives it (truncation_by_distance()).
///
/// Throws InputError that lists every violation: S not positive, a faulty axis or direction, missing FRFs (each named),
/// a value that is not finite, a faulty section, `corrected` without a section, noise of another shape. Throws
/// NumericalError, with the frequency, if the rank-one rule divides by H = 0. Cost O(lines).
[[nodiscard]] TipReceptance finite_difference_rotations(const dynamics::ResponseModel& displacements,
                                                        const DifferencePoints& points,
                                                        const RotationOptions& options = {});

/// Richardson's estimate of the truncation of `near`, T(S₁) − true ≈ (T(S₂) − T(S₁)) S₁/(S₂ − S₁), from the same tip at
/// a larger distance. It finds the part of the error that is proportional to S; other parts (c_F and 1/κGAS above)
/// remain unseen. Throws InputError unless both have the same axis and DOFs and 0 < S₁ < S₂.
[[nodiscard]] std::vector<Eigen::MatrixXcd> truncation_by_distance(const dynamics::ResponseModel& near,
                                                                   double near_distance_m,
                                                                   const dynamics::ResponseModel& far,
                                                                   double far_distance_m);

/// The bound |truncation| + its uncertainty + |rank one| + k noise on the error of every entry, one matrix for each
/// line, with the confidence of k standard deviations (the modulus of the noise exceeds k σ with probability
/// e^{−k²/2}). The rank-one part counts if the rule was `rank_one`. Throws InputError if the truncation is not known,
/// or unless k ≥ 0.
[[nodiscard]] std::vector<Eigen::MatrixXd> error_bound(const RotationErrors& errors, RotationRule rule, double k);

}  // namespace thinwall::coupling

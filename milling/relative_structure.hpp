#pragma once
// What the cut feels: the displacement of the tool relative to the part under a force between them.

#include <Eigen/Core>
#include <complex>
#include <string>

#include "dynamics/modal_model.hpp"

namespace thinwall::milling {

/// Relative receptance at the cut, 3 × 3, m/N, part axes. A force f on the tool is −f on the part, and q is tool minus
/// part, so the receptances add:
///
///     G(ω) = Σ_k φ_k b_kᵀ / (iω − λ_k) + conjugates + R,     b = ψ / a
///
/// One column for each conjugate pair (Im λ > 0) or real pole. R, the modes that are not listed, is quasi-static;
/// stability is computed without it, and `residual_share` says how much that leaves out.
struct RelativeStructure {
  Eigen::VectorXcd poles;  ///< rad/s, Re < 0, Im ≥ 0
  Eigen::Matrix3Xcd phi;   ///< response shapes
  Eigen::Matrix3Xcd b;     ///< force shapes over the modal scaling
  Eigen::Matrix3d R = Eigen::Matrix3d::Zero();
};

/// The structure seen at one point of a modal model, from all translational DOFs of that point (any directions).
/// Throws InputError if the point is unknown or does not translate, if a pole does not decay (Re λ ≥ 0), or if complex
/// poles are not listed in conjugate pairs, positive imaginary part first; DataError if anything is not finite. Cost
/// O(poles).
[[nodiscard]] RelativeStructure relative_structure(const dynamics::ModalModel& model, const std::string& point);

/// Sum of two receptances: part and tool, in any order.
[[nodiscard]] RelativeStructure sum(const RelativeStructure& a, const RelativeStructure& b);

/// G(ω) without the residual, 3 × 3, m/N.
[[nodiscard]] Eigen::Matrix3cd receptance(const RelativeStructure& structure, double omega_rad_s);

/// ‖R‖ / ‖G(0)‖ (Frobenius, G with R): the part of the static compliance that the stability analysis leaves out.
[[nodiscard]] double residual_share(const RelativeStructure& structure);

}  // namespace thinwall::milling

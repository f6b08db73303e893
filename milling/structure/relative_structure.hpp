#pragma once
// The structure that the cut feels: the displacement of the tool relative to the part under a force between them.

#include <Eigen/Core>
#include <complex>
#include <string>

#include "dynamics/modal_model.hpp"
#include "milling/cut/tool.hpp"

namespace thinwall::milling {

/// Relative receptance at the cut, 3 × 3, m/N, part axes. A force f on the tool is −f on the part, and q is tool minus
/// part, so the receptances add:
///
///     G(ω) = Σ_k φ_k b_kᵀ / (iω − λ_k) + conjugates + R,     b = ψ / a
///
/// One column for each conjugate pair (Im λ > 0) or real pole. R, the modes that are not listed, is quasi-static.
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

/// Two points elsewhere that a pair of opposite unit forces along a line pushes apart, with the same poles as the
/// structure at the cut: what one does to the other.
struct ForcePair {
  Eigen::VectorXcd phi;                                ///< the distance between the points along the line, of each pole
  Eigen::VectorXcd b;                                  ///< force shapes of the pair over the modal scaling
  Eigen::Vector3d at_cut = Eigen::Vector3d::Zero();    ///< quasi-static q at the cut under the pair, m/N, part axes
  Eigen::Vector3d from_cut = Eigen::Vector3d::Zero();  ///< distance under forces on the tool at the cut, m/N
  double residual = 0.0;                               ///< distance under the pair, m/N
};

/// The pair of forces along the unit vector `direction`, on `first` with it and on `second` against it, for the
/// structure that relative_structure(model, cut) gives, and zeros for `further` poles behind these. Throws InputError
/// for an unknown point.
[[nodiscard]] ForcePair force_pair(const dynamics::ModalModel& model, const std::string& cut, const std::string& first,
                                   const std::string& second, const Eigen::Vector3d& direction,
                                   Eigen::Index further = 0);

/// Sum of two receptances: part and tool, in any order.
[[nodiscard]] RelativeStructure sum(const RelativeStructure& a, const RelativeStructure& b);

/// The structure in the tool's axes.
[[nodiscard]] RelativeStructure in_tool_axes(const RelativeStructure& structure, const ToolFrame& frame);

/// G(ω), 3 × 3, m/N.
[[nodiscard]] Eigen::Matrix3cd receptance(const RelativeStructure& structure, double omega_rad_s);

/// ‖R‖ / ‖G(0)‖ (Frobenius): the part of the static compliance that has no dynamics of its own here. The collocation
/// takes it as it is; semi-discretization leaves it out.
[[nodiscard]] double residual_share(const RelativeStructure& structure);

/// Directions (orthonormal columns, 3 × p) in which the structure moves, or feels a force, by more than round-off,
/// modes weighed by their compliance. Throws InputError if there is none that the chip sees: tool axes are meant, and
/// the chip of a cylindrical cutter sees the first two only, that of other envelopes the axis as well
/// (`chip_sees_axis`).
[[nodiscard]] Eigen::Matrix3Xd yielding_directions(const RelativeStructure& structure, bool chip_sees_axis = false);

}  // namespace thinwall::milling

#pragma once
// Effective masses: the share of a part's mass and inertia that each mode carries when its interface is moved.

#include <Eigen/Core>

namespace thinwall::reduction {

/// Effective masses of the modes with the interface held (docs/theory/reductions.md, Eq. 18; Craig & Chang 1977; Girard
/// & Roy 2008). With Y the rigid-body motions (translations, rotations about the reference) in the model's coordinates,
/// φ the modes of B φ = 0 and L = φᵀ M Y
///
///     Σ_k L_kj² + own_j = (Yᵀ M Y)_jj,     own = rᵀ (B M⁻¹ Bᵀ)⁻¹ r,  r = B Y
///
/// where `own` is the mass of the interface's DOFs themselves, which does not move in modes with the interface held.
/// The sum over all modes of the model is exact; for a full model, `total` is the rigid-body mass.
struct EffectiveMass {
  Eigen::VectorXd frequency_hz;   ///< frequencies with the interface held
  Eigen::MatrixXd mass;           ///< modes × 6, kg and kg m²
  Eigen::VectorXd interface_own;  ///< 6
  Eigen::VectorXd total;          ///< 6: diagonal of YᵀMY
  double closure = 0.0;           ///< largest of |Σ + own − total| / total
  bool available = false;         ///< false if M is not positive definite with the interface held
};

/// The effective masses of a model. K, M: n × n; B: interface × n; Y: n × 6. M may be singular as long as no motion
/// with the interface held is without mass. Cost O(n³).
[[nodiscard]] EffectiveMass effective_mass(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M, const Eigen::MatrixXd& B,
                                           const Eigen::MatrixXd& Y);

}  // namespace thinwall::reduction

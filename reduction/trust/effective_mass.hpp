#pragma once
// Which share of a part's mass and inertia each mode carries when its interface is shaken.

#include <Eigen/Core>

namespace thinwall::reduction {

/// Effective masses of the modes with the interface held (docs/theory/reductions.md, Eq. 18; Craig & Chang 1977; Girard
/// & Roy 2008). With Y the rigid-body motions (translations, rotations about the reference) in the model's coordinates,
/// φ the modes of B φ = 0 and L = φᵀ M Y
///
///     Σ_k L_kj² + own_j = (Yᵀ M Y)_jj,     own = rᵀ (B M⁻¹ Bᵀ)⁻¹ r,  r = B Y
///
/// own: the mass of the interface's DOFs themselves, which no mode with the interface held moves. Over all modes of the
/// model the sum is exact; over those of a full model `total` is the rigid-body mass.
struct EffectiveMass {
  Eigen::VectorXd frequency_hz;   ///< with the interface held
  Eigen::MatrixXd mass;           ///< modes × 6, kg and kg m²
  Eigen::VectorXd interface_own;  ///< 6
  Eigen::VectorXd total;          ///< 6: diagonal of YᵀMY
  double closure = 0.0;           ///< largest of |Σ + own − total| / total
  bool available = false;         ///< false: M is not positive definite with the interface held
};

/// K, M: n × n; B: interface × n, Y: n × 6. Where M is singular (MacNeal's model) `own` is the difference, and closure
/// 0. Cost O(n³).
[[nodiscard]] EffectiveMass effective_mass(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M, const Eigen::MatrixXd& B,
                                           const Eigen::MatrixXd& Y);

}  // namespace thinwall::reduction

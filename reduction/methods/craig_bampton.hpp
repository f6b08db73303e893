#pragma once
// Craig-Bampton: constraint modes at the interface, fixed-interface modes inside.

#include <Eigen/Core>
#include <optional>

#include "dynamics/spatial_model.hpp"
#include "linalg/eigenpairs.hpp"
#include "reduction/interface.hpp"

namespace thinwall::reduction {

/// How many fixed-interface modes are kept.
struct CraigBamptonOptions {
  int modes = 30;                    ///< used if up_to_hz is not given
  std::optional<double> up_to_hz{};  ///< all fixed-interface modes below this frequency instead
};

/// The reduced model and the way back: u = T q with q = (u_b, η).
struct [[nodiscard]] CraigBampton {
  dynamics::SpatialModel model;        ///< M, K; C empty-zero; DOFs: interface first, then "mode 1" …
  Eigen::MatrixXd T;                   ///< full × (interface + modes): [Ψ Φ]
  Eigen::VectorXd fixed_interface_hz;  ///< frequencies of the kept modes
  linalg::EigenStatus status = linalg::EigenStatus::converged;
};

/// Reduction of Craig and Bampton (1968) for an interface of weighted averages Wᵀu. With S the inverse of K_s = K + s W
/// Wᵀ (s = 0 serves for a held part; the added term does no work where Wᵀu = 0 and is constant where Wᵀu is given, so
/// it changes neither kind of mode):
///
///     F = (Wᵀ S W)⁻¹,   Ψ = S W F            constraint modes, Wᵀ Ψ = I (Craig & Bampton 1968, Eq. 8)
///     S₀ = S − S W F Wᵀ S = S − Ψ Wᵀ S      the inverse of K_ii, embedded: Wᵀ S₀ = 0
///     S₀ M φ = φ / ω²                        fixed-interface modes (Eq. 10)
///     M_r = Tᵀ M T,   K_r = Tᵀ K T = diag(Ψᵀ K Ψ, ω²),   T = [Ψ Φ]
///
/// For an interface of single nodes this is the textbook partition, K_ii being K with the interface struck out; the
/// factor behind S serves both kinds of mode. K, M: free × free; `inverse` the action of S (its sigma must be 0).
/// Throws InputError if the interface DOFs depend on each other or the modes asked for outnumber the inner DOFs; status
/// as of the eigen-solver. Small models that ask for most of their modes are solved densely. Cost: one solve of
/// interface-many right-hand sides beside the eigen-solution.
CraigBampton craig_bampton(const linalg::SparseMatrix& K, const linalg::SparseMatrix& M,
                           const linalg::ShiftedInverse& inverse, const Interface& interface,
                           const CraigBamptonOptions& options);

/// K + s W Wᵀ with s = tr K / n, for a part whose rigid motions only the interface restrains.
[[nodiscard]] linalg::SparseMatrix restrained(const linalg::SparseMatrix& K, const Interface& interface);

}  // namespace thinwall::reduction

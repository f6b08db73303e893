#pragma once
// Craig-Bampton reduction: constraint modes at the interface, fixed-interface modes inside.

#include <Eigen/Core>
#include <optional>

#include "dynamics/spatial_model.hpp"
#include "linalg/eigenpairs.hpp"
#include "reduction/interface.hpp"

namespace thinwall::reduction {

/// The fixed-interface modes to keep, by number or by frequency.
struct CraigBamptonOptions {
  int modes = 30;                    ///< number of modes; used if up_to_hz is not given
  std::optional<double> up_to_hz{};  ///< if given, all fixed-interface modes below this frequency instead
};

/// The reduced model and the transformation back to the full one, u = T q with q = (u_b, η).
struct [[nodiscard]] CraigBampton {
  dynamics::SpatialModel model;        ///< M, K, and C = 0; DOFs: the interface, then "mode 1" …
  Eigen::MatrixXd T;                   ///< full × (interface + modes): [Ψ Φ]
  Eigen::VectorXd fixed_interface_hz;  ///< frequencies of the kept modes
  linalg::EigenStatus status = linalg::EigenStatus::converged;
};

/// The reduction of Craig and Bampton (1968) for an interface of weighted averages Wᵀu (docs/theory/elements.md, Eq.
/// 5). S is the inverse of K_s = K + s W Wᵀ. s = 0 is taken for a held part; for others the added term makes K_s
/// regular and changes neither kind of mode, because it does no work where Wᵀu = 0 and is constant where Wᵀu is given:
///
///     F = (Wᵀ S W)⁻¹,   Ψ = S W F            constraint modes, Wᵀ Ψ = I (Craig & Bampton 1968, Eq. 8)
///     S₀ = S − S W F Wᵀ S = S − Ψ Wᵀ S      the inverse of K_ii, embedded: Wᵀ S₀ = 0
///     S₀ M φ = φ / ω²                        fixed-interface modes (Eq. 10)
///     M_r = Tᵀ M T,   K_r = Tᵀ K T = diag(Ψᵀ K Ψ, ω²),   T = [Ψ Φ]
///
/// For an interface of single nodes this is the textbook partition, with K_ii = K without the rows and columns of the
/// interface. With weighted averages there is no such partition, and S₀ takes the place of K_ii⁻¹; one factor, that
/// behind S, then serves both kinds of mode. K, M: free × free; `inverse`: the action of S (sigma must be 0). Throws
/// InputError if the interface DOFs depend on each other or more modes are asked for than there are inner DOFs; the
/// status is that of the eigen-solver. Models of up to 600 rows are solved densely. Cost: one solve of interface-many
/// right-hand sides beside the eigen-solution.
CraigBampton craig_bampton(const linalg::SparseMatrix& K, const linalg::SparseMatrix& M,
                           const linalg::ShiftedInverse& inverse, const Interface& interface,
                           const CraigBamptonOptions& options);

/// The matrix K + s W Wᵀ with s = tr K / n, for a part whose rigid motions only the interface restrains.
[[nodiscard]] linalg::SparseMatrix restrained(const linalg::SparseMatrix& K, const Interface& interface);

}  // namespace thinwall::reduction

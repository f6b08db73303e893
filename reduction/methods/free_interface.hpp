#pragma once
// What free-interface methods share: the part's own modes, and what a unit force at the interface does beyond them.

#include <Eigen/Core>

#include "dynamics/spatial_model.hpp"
#include "linalg/eigenpairs.hpp"
#include "reduction/full_model.hpp"
#include "reduction/interface.hpp"
#include "reduction/methods/static_flexibility.hpp"

namespace thinwall::reduction {

/// Modes of a part over its full model, the same wherever it is loaded: ΦᵀMΦ = I, ΦᵀKΦ = diag(λ).
struct PartModes {
  Eigen::VectorXd lambda;  ///< rad²/s², ascending; exactly 0 for rigid-body modes
  Eigen::MatrixXd Phi;     ///< full × modes
  linalg::EigenStatus status = linalg::EigenStatus::converged;
};

/// All rigid-body modes, then the lowest `elastic` modes of the part, by block Lanczos on G; small models (600 rows)
/// densely. Throws InputError if the model has fewer.
[[nodiscard]] PartModes free_modes(const FullModel& full, const StaticFlexibility& flexibility, int elastic);

/// All rigid-body modes, and the elastic ones up to at least 1.2 `hz`, the last beyond it, or all there are. Cost: as
/// free_modes(), several times over where no mode lies just beyond.
[[nodiscard]] PartModes free_modes_beyond(const FullModel& full, const StaticFlexibility& flexibility, double hz);

/// The part as its interface sees it (docs/theory/reductions.md, Eq. 6): with p = Φᵀ W and G the elastic flexibility,
///
///     A = G W − Σ_{λ>0} φ pᵀ/λ,    F = Wᵀ A,    J = Aᵀ M A        residual attachment modes, flexibility and inertia
///     H(z) = Σ p pᵀ/(λ − z) + F + z J + O(z²)
///
/// (MacNeal 1971; Rubin 1975)
struct FreeInterface {
  Eigen::VectorXd lambda;       ///< of the modes kept, rad²/s²
  Eigen::MatrixXd p;            ///< modes × interface
  Eigen::MatrixXd flexibility;  ///< Wᵀ G W
  Eigen::MatrixXd F;            ///< interface × interface
  Eigen::MatrixXd J;            ///< interface × interface
  Eigen::MatrixXd coupling;     ///< Φᵀ M A, modes × interface: round-off for exact modes
  dynamics::DofTable dofs;      ///< of the interface
};

/// `flexibility`: the action of G, sigma 0. Throws InputError if the interface DOFs depend on each other,
/// NumericalError for a shifted inverse. Cost: a solve of interface-many right-hand sides and O(full · modes ·
/// interface).
[[nodiscard]] FreeInterface free_interface(const PartModes& modes, const linalg::SparseMatrix& M,
                                           const linalg::ShiftedInverse& flexibility, const Interface& interface);

/// Whether a reduced model keeps J and ΦᵀMA or leaves the residual attachment modes without inertia.
enum class ResidualInertia { kept, neglected };

/// y = (η, g): Eq. 8, with g in the directions V in which something was left out, VᵀFV = I (fewer than the interface
/// where F is singular, none with all modes kept):
///
///     K = diag(λ, I),   M = [ I  ΦᵀMA V ; …  VᵀJV ],   x = pᵀη + F V g
///
/// DOFs: the interface, then "mode 1" …, then "residual 1" …; the model has coordinates of its own.
[[nodiscard]] dynamics::SpatialModel in_modes_and_forces(const FreeInterface& part, ResidualInertia inertia);

/// y = (x, η): Eq. 9, V g = F⁻¹ (x − pᵀη) put into the above: the interface's DOFs are coordinates, then "mode 1" ….
/// Where F is singular to 1e-11 this does not exist: in_modes_and_forces() instead.
[[nodiscard]] dynamics::SpatialModel in_interface_coordinates(const FreeInterface& part, ResidualInertia inertia);

}  // namespace thinwall::reduction

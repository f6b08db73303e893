#pragma once
// The common basis of free-interface methods: the part's own modes, and the response to unit forces at the interface
// beyond those modes.

#include <Eigen/Core>

#include "dynamics/spatial_model.hpp"
#include "linalg/eigenpairs.hpp"
#include "reduction/full_model.hpp"
#include "reduction/interface.hpp"
#include "reduction/methods/static_flexibility.hpp"

namespace thinwall::reduction {

/// The modes of a part over its full model, independent of any interface: ΦᵀMΦ = I, ΦᵀKΦ = diag(λ).
struct PartModes {
  Eigen::VectorXd lambda;  ///< rad²/s², ascending; exactly 0 for rigid-body modes
  Eigen::MatrixXd Phi;     ///< full × modes
  linalg::EigenStatus status = linalg::EigenStatus::converged;
};

/// All rigid-body modes, then the lowest `elastic` modes of the part: by block Lanczos on G, or densely for models of
/// up to 600 rows. Throws InputError if the model has fewer.
[[nodiscard]] PartModes free_modes(const FullModel& full, const StaticFlexibility& flexibility, int elastic);

/// All rigid-body modes, and the elastic ones up to at least 1.2 `hz`, of which the last lies beyond that bound, or all
/// if there are no more. Cost: that of free_modes(), several times over if no mode lies just beyond.
[[nodiscard]] PartModes free_modes_beyond(const FullModel& full, const StaticFlexibility& flexibility, double hz);

/// A part in terms of its interface (docs/theory/reductions.md, Eq. 6): with p = Φᵀ W and G the elastic flexibility,
///
///     A = G W − Σ_{λ>0} φ pᵀ/λ,    F = Wᵀ A,    J = Aᵀ M A        residual attachment modes, flexibility and inertia
///     H(z) = Σ p pᵀ/(λ − z) + F + z J + O(z²)
///
/// (MacNeal 1971; Rubin 1975)
struct FreeInterface {
  Eigen::VectorXd lambda;       ///< λ of the modes kept, rad²/s²
  Eigen::MatrixXd p;            ///< modes × interface
  Eigen::MatrixXd flexibility;  ///< Wᵀ G W
  Eigen::MatrixXd F;            ///< interface × interface
  Eigen::MatrixXd J;            ///< interface × interface
  Eigen::MatrixXd coupling;     ///< Φᵀ M A, modes × interface: round-off for exact modes
  dynamics::DofTable dofs;      ///< DOFs of the interface
};

/// The modes and residual quantities of a part at an interface. `flexibility`: the action of G, sigma 0. Throws
/// InputError if the interface DOFs depend on each other, NumericalError for a shifted inverse. Cost: a solve of
/// interface-many right-hand sides and O(full · modes · interface).
[[nodiscard]] FreeInterface free_interface(const PartModes& modes, const linalg::SparseMatrix& M,
                                           const linalg::ShiftedInverse& flexibility, const Interface& interface);

/// The inertia of residual attachment modes in a reduced model: J and ΦᵀMA are kept, or neglected.
enum class ResidualInertia { kept, neglected };

/// The reduced model in the coordinates y = (η, g) (docs/theory/reductions.md, Eq. 8). The forces g are those in the
/// directions V, VᵀFV = I, in which the modes leave something out; there are fewer than interface DOFs if F is
/// singular, none if all modes are kept:
///
///     K = diag(λ, I),   M = [ I  ΦᵀMA V ; …  VᵀJV ],   x = pᵀη + F V g
///
/// The DOFs are the interface, then "mode 1" …, then "residual 1" …; the coordinates differ from the DOFs.
[[nodiscard]] dynamics::SpatialModel in_modes_and_forces(const FreeInterface& part, ResidualInertia inertia);

/// The reduced model in the coordinates y = (x, η) (docs/theory/reductions.md, Eq. 9), with V g = F⁻¹ (x − pᵀη)
/// inserted in the above. The coordinates are the interface's DOFs, then "mode 1" …. If F is singular to 1e-11 they do
/// not exist, and in_modes_and_forces() is returned instead.
[[nodiscard]] dynamics::SpatialModel in_interface_coordinates(const FreeInterface& part, ResidualInertia inertia);

}  // namespace thinwall::reduction

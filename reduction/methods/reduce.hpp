#pragma once
// All reduction methods in one function.

#include <variant>

#include "dynamics/modal_model.hpp"
#include "dynamics/spatial_model.hpp"
#include "linalg/eigenpairs.hpp"
#include "reduction/full_model.hpp"
#include "reduction/interface.hpp"
#include "reduction/methods/method.hpp"

namespace thinwall::reduction {

/// Options of all methods.
struct ReductionOptions {
  int modes = 30;              ///< elastic modes beside all rigid-body modes, ≥ 0; ignored by guyan
  int characteristic = 6;      ///< amplitudes, 1 … interface DOFs; for characteristic_constraint_modes
  double damping_ratio = 0.0;  ///< ζ of every pole, 0 … 1; modal_truncation only, the others are undamped (damping.hpp)
};

/// The reduced model: matrices, or poles for modal truncation.
using ReducedModel = std::variant<dynamics::SpatialModel, dynamics::ModalModel>;

/// A reduced model, whose table begins with the interface's DOFs.
struct [[nodiscard]] Reduction {
  Method method = Method::craig_bampton;
  ReducedModel model;
  int modes = 0;  ///< elastic modes kept
  linalg::EigenStatus status = linalg::EigenStatus::converged;
  double seconds = 0.0;  ///< wall time including factorisations
};

/// The size of a reduced model: coordinates of a spatial model, pairs of poles of a modal one; for dual Craig-Bampton
/// without the interface's displacements, as modes_for_size() counts.
[[nodiscard]] int size(const Reduction& reduction);

/// The reduced model of a held or free part at its interface (docs/theory/reductions.md, Eq. 3-12). Throws InputError
/// if the model has fewer modes than were asked for, if interface DOFs depend on each other, if the method holds the
/// interface but the interface does not hold the part, and for what the method itself refuses; NumericalError if K is
/// singular beyond full.rigid. Cost: one factorisation, the eigen-solution, two solves of interface-many right-hand
/// sides.
Reduction reduce(Method method, const FullModel& full, const Interface& interface,
                 const ReductionOptions& options = {});

}  // namespace thinwall::reduction

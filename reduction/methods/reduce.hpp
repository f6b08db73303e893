#pragma once
// Any reduction by one call.

#include <variant>

#include "dynamics/modal_model.hpp"
#include "dynamics/spatial_model.hpp"
#include "linalg/eigenpairs.hpp"
#include "reduction/full_model.hpp"
#include "reduction/interface.hpp"
#include "reduction/methods/method.hpp"

namespace thinwall::reduction {

/// What all methods understand.
struct ReductionOptions {
  int modes = 30;          ///< elastic modes beside all rigid-body modes, ≥ 0; guyan takes none
  int characteristic = 6;  ///< amplitudes of a reduced interface, 1 … interface DOFs; characteristic_constraint_modes
  double damping_ratio = 0.0;  ///< ζ of every pole, 0 … 1; modal_truncation only, the others are undamped (damping.hpp)
};

/// By matrices, or by poles where the method is modal truncation.
using ReducedModel = std::variant<dynamics::SpatialModel, dynamics::ModalModel>;

/// A reduced model: the interface's DOFs first in its table.
struct [[nodiscard]] Reduction {
  Method method = Method::craig_bampton;
  ReducedModel model;
  int modes = 0;  ///< elastic modes kept
  linalg::EigenStatus status = linalg::EigenStatus::converged;
  double seconds = 0.0;  ///< wall time with the factorisations
};

/// Coordinates of a spatial model, pairs of poles of a modal one; of dual Craig-Bampton without the interface's
/// displacements, as modes_for_size() counts.
[[nodiscard]] int size(const Reduction& reduction);

/// Reduces a held or free part to its interface (docs/theory/reductions.md, Eq. 3-12). Throws InputError if the model
/// has fewer modes than were asked for, if interface DOFs depend on each other, if a method that holds the interface
/// gets a part that it does not hold, and what the method itself refuses; NumericalError where K is singular beyond
/// full.rigid. Cost: one factorisation, the eigen-solution, two solves of interface-many right-hand sides.
Reduction reduce(Method method, const FullModel& full, const Interface& interface,
                 const ReductionOptions& options = {});

}  // namespace thinwall::reduction

#pragma once
// The factorisation with which methods that hold the interface begin.

#include "linalg/sparse_cholesky.hpp"
#include "reduction/full_model.hpp"
#include "reduction/interface.hpp"

namespace thinwall::reduction {

/// The factor of K, or of K restrained at the interface (craig_bampton.hpp) if the part is free. Throws InputError if a
/// free part could still move with its interface held, NumericalError if K is singular beyond full.rigid. Cost: the
/// factorisation.
[[nodiscard]] linalg::SparseCholesky held_by_interface(const FullModel& full, const Interface& interface);

}  // namespace thinwall::reduction

#pragma once
// Conversion between imported sparse matrices and the spatial model.

#include "dynamics/sparse_model.hpp"
#include "dynamics/spatial_model.hpp"

namespace thinwall::dynamics {

/// The imported model as a spatial model with dense matrices and named DOFs ("node 17.x"); C is zero if the model has
/// none. Throws InputError as require_consistent() does, and for more than `most` rows (three dense matrices of 5000
/// rows take 600 MB). Cost O(n²).
[[nodiscard]] SpatialModel spatial_model(const SparseModel& model, Eigen::Index most = 5000);

/// The spatial model as sparse matrices by nodes and components. Zeros are left out, and so is a C that is zero. The
/// point "node 17" becomes node 17, any other point the next free number, with its name. Throws InputError for what
/// nodes and components cannot express: a direction that is no positive axis, coordinates that are not the DOFs,
/// structural damping. spatial_model() of the result gives the model back, bit by bit. Cost O(n²).
[[nodiscard]] SparseModel sparse_model(const SpatialModel& model);

}  // namespace thinwall::dynamics

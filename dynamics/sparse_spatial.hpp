#pragma once
// Imported matrices and the vocabulary's spatial model, in either direction.

#include "dynamics/sparse_model.hpp"
#include "dynamics/spatial_model.hpp"

namespace thinwall::dynamics {

/// The same model with dense matrices and named DOFs ("node 17.x"); C zero where there is none. Throws InputError as
/// require_consistent(), and for more than `most` rows (three dense matrices of 5000 take 600 MB). Cost O(n²).
[[nodiscard]] SpatialModel spatial_model(const SparseModel& model, Eigen::Index most = 5000);

/// The other way: zeros are left out, C too where it is zero. The point "node 17" becomes node 17, any other point the
/// next number that is free, with its name. Throws InputError for what node and component do not say: a direction that
/// is no positive axis, coordinates of their own, structural damping. spatial_model() of the result is the model, bit
/// by bit. Cost O(n²).
[[nodiscard]] SparseModel sparse_model(const SpatialModel& model);

}  // namespace thinwall::dynamics

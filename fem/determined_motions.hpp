#pragma once
// A check that the points of a free part determine all of its rigid motions.

#include <Eigen/Core>

#include "fem/modes.hpp"

namespace thinwall::fem {

/// Throws InputError, with the motions in words, unless the displacements of the points determine every rigid motion of
/// a free part. Such a part is held only by what is joined to its points; points on one line, for instance, do not
/// determine the rotation about it. `amplitudes` = Wᵀ Φ (points' directions × modes); the rank of its first
/// modes.rigid_motions columns is taken with a relative threshold of 1e-6. Cost O(directions · motions²).
void require_motions_determined(const Model& model, const Modes& modes, const Eigen::MatrixXd& amplitudes);

}  // namespace thinwall::fem

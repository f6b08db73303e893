#pragma once
// Whether the points of a free part see every way in which it can move rigidly.

#include <Eigen/Core>

#include "fem/modes.hpp"

namespace thinwall::fem {

/// A part that can move rigidly is held by what joins it at its points, so they must see all of its rigid motions:
/// points on one line, say, do not see the turn about it. `amplitudes` = Wᵀ Φ (points' directions × modes), of which
/// the first modes.rigid_motions columns are looked at, with a relative threshold of 1e-6. Throws InputError, with the
/// motions in words, if their rank is less. Cost O(directions · motions²).
void require_motions_seen(const Model& model, const Modes& modes, const Eigen::MatrixXd& amplitudes);

}  // namespace thinwall::fem

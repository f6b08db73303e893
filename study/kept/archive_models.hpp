#pragma once
// The three kinds of models as bytes and back, for cereal, which looks in each type's own namespace.

#include "dynamics/modal_model.hpp"
#include "dynamics/response_model.hpp"
#include "dynamics/spatial_model.hpp"
#include "study/kept/archive.hpp"

namespace thinwall::dynamics {

/// Writes or reads a DOF.
template <class Archive>
void serialize(Archive& archive, Dof& d) {
  archive(d.point, d.direction, d.kind);
}
/// Writes or reads a spatial model.
template <class Archive>
void serialize(Archive& archive, SpatialModel& m) {
  archive(m.M, m.C, m.K, m.D, m.dofs, m.T);
}
/// Writes or reads a modal model.
template <class Archive>
void serialize(Archive& archive, ModalModel& m) {
  archive(m.poles, m.right, m.left, m.scaling, m.residual, m.dofs);
}
/// Writes or reads a frequency axis.
template <class Archive>
void serialize(Archive& archive, FrequencyAxis& a) {
  archive(a.hz);
}
/// Writes or reads a response model.
template <class Archive>
void serialize(Archive& archive, ResponseModel& m) {
  archive(m.axis, m.responses, m.forces, m.H);
}

}  // namespace thinwall::dynamics

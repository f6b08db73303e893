#include "reduction/methods/dual_craig_bampton.hpp"

#include <string>

namespace thinwall::reduction {

using Eigen::Index;
using Eigen::MatrixXd;

dynamics::SpatialModel dual_craig_bampton(const FreeInterface& part) {
  const Index nb = part.F.rows(), nm = part.lambda.size(), n = 2 * nb + nm;
  // A DOF that only moves with the rigid body has no flexibility; it gets the least unit instead of an infinite one.
  const double least = 1e-14 * part.flexibility.diagonal().maxCoeff();
  const Eigen::VectorXd unit = part.flexibility.diagonal().cwiseMax(least).cwiseInverse();
  const auto scale = unit.asDiagonal();
  dynamics::SpatialModel model{MatrixXd::Zero(n, n), MatrixXd::Zero(n, n), MatrixXd::Zero(n, n), {}, part.dofs};
  model.K.diagonal().segment(nb, nm) = part.lambda;
  model.K.topRightCorner(nb, nb) = scale;
  model.K.block(nb, nb + nm, nm, nb) = -part.p * scale;
  model.K.bottomRightCorner(nb, nb) = -(scale * part.F * scale);
  model.K.bottomLeftCorner(nb, nb + nm) = model.K.topRightCorner(nb + nm, nb).transpose();
  model.M.diagonal().segment(nb, nm).setOnes();
  model.M.block(nb, nb + nm, nm, nb) = part.coupling * scale;
  model.M.block(nb + nm, nb, nb, nm) = model.M.block(nb, nb + nm, nm, nb).transpose();
  model.M.bottomRightCorner(nb, nb) = scale * part.J * scale;
  const auto name = [&](const char* kind, Index count) {
    for (Index k = 0; k < count; ++k)
      model.dofs.push_back({kind + std::to_string(k + 1), Eigen::Vector3d::Zero(), dynamics::DofKind::modal});
  };
  name("mode ", nm);
  name("force ", nb);
  return model;
}

}  // namespace thinwall::reduction

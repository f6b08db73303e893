#include "reduction/methods/characteristic_constraint_modes.hpp"

#include <numbers>
#include <string>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"

namespace thinwall::reduction {

CharacteristicModel characteristic_constraint_modes(const CraigBampton& reduced, int modes) {
  const dynamics::SpatialModel& full = reduced.model;
  const Eigen::Index nm = reduced.fixed_interface_hz.size(), nb = full.size() - nm, nc = modes;
  if (nc < 1 || nc > nb) {
    throw core::InputError("asked for " + std::to_string(modes) +
                           " characteristic constraint modes of an interface of " + std::to_string(nb) +
                           " degrees of freedom: ask for 1 to " + std::to_string(nb));
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(full.K.topLeftCorner(nb, nb),
                                                                        full.M.topLeftCorner(nb, nb));
  CharacteristicModel result;
  result.psi = eigen.eigenvectors().leftCols(nc);
  // λ of rigid motions is round-off of either sign.
  const Eigen::VectorXd lambda = eigen.eigenvalues().head(nc).cwiseMax(0.0);
  result.frequency_hz = lambda.cwiseSqrt() / (2.0 * std::numbers::pi);
  dynamics::SpatialModel& model = result.model;
  const Eigen::Index n = nc + nm;
  model.K = Eigen::MatrixXd::Zero(n, n);
  model.K.diagonal().head(nc) = lambda;
  model.K.diagonal().tail(nm) = full.K.diagonal().tail(nm);
  model.M = Eigen::MatrixXd::Identity(n, n);
  model.M.topRightCorner(nc, nm) = result.psi.transpose() * full.M.topRightCorner(nb, nm);
  model.M.bottomLeftCorner(nm, nc) = model.M.topRightCorner(nc, nm).transpose();
  model.C = Eigen::MatrixXd::Zero(n, n);
  model.T = Eigen::MatrixXd::Zero(nb + n, n);
  model.T.topLeftCorner(nb, nc) = result.psi;
  model.T.bottomRows(n).setIdentity();
  model.dofs.assign(full.dofs.begin(), full.dofs.begin() + nb);
  for (Eigen::Index k = 0; k < nc; ++k)
    model.dofs.push_back(
        {"characteristic " + std::to_string(k + 1), Eigen::Vector3d::Zero(), dynamics::DofKind::modal});
  model.dofs.insert(model.dofs.end(), full.dofs.begin() + nb, full.dofs.end());
  return result;
}

}  // namespace thinwall::reduction

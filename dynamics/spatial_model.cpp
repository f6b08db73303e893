#include "dynamics/spatial_model.hpp"

#include <string>

#include "core/error.hpp"

namespace thinwall::dynamics {

void require_consistent(const SpatialModel& model) {
  const auto dofs = static_cast<Eigen::Index>(model.dofs.size());
  if (dofs == 0) throw core::InputError("a spatial model without degrees of freedom");
  const Eigen::Index n = model.has_own_coordinates() ? model.T.cols() : dofs;
  const auto check = [&](const Eigen::MatrixXd& matrix, const char* letter, Eigen::Index rows) {
    if (matrix.rows() != rows || matrix.cols() != n) {
      throw core::InputError("matrix " + std::string(letter) + " is " + std::to_string(matrix.rows()) + " x " +
                             std::to_string(matrix.cols()) + ", but the table names " + std::to_string(dofs) +
                             " degrees of freedom" +
                             (model.has_own_coordinates() ? " and T has " + std::to_string(n) + " columns" : ""));
    }
    if (!matrix.allFinite())
      throw core::InputError("matrix " + std::string(letter) + " holds a value that is not finite");
  };
  check(model.M, "M", n);
  check(model.C, "C", n);
  check(model.K, "K", n);
  if (model.has_structural_damping()) check(model.D, "D", n);
  if (model.has_own_coordinates()) check(model.T, "T", dofs);
}

Eigen::MatrixXd displacements(const SpatialModel& model) {
  if (model.has_own_coordinates()) return model.T;
  return Eigen::MatrixXd::Identity(model.size(), model.size());
}

Eigen::VectorXd coordinate_row(const SpatialModel& model, const std::string& point, const Eigen::Vector3d& n,
                               DofKind kind) {
  Eigen::VectorXd row = displacement_row(model.dofs, point, n, kind);
  if (!model.has_own_coordinates()) return row;
  return model.T.transpose() * row;
}

}  // namespace thinwall::dynamics

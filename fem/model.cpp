#include "fem/model.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "fem/attach.hpp"
#include "fem/free_motions.hpp"

namespace thinwall::fem {

Model build_model(mesh::TetMesh mesh, mesh::LagrangeNodes nodes, const Materials& materials,
                  const std::vector<int>& fixed, const Attachments& attachments) {
  Model model;
  model.mesh = std::move(mesh);
  model.nodes = std::move(nodes);
  Assembled assembled = assemble(model.nodes, materials, fixed);
  model.mass = mass_properties(assembled.node_mass, model.nodes);
  model.K = std::move(assembled.K);
  model.M = std::move(assembled.M);
  model.spectrum_rad2_s2 = model.K.diagonal().sum() / model.M.diagonal().sum();
  model.free_rows = std::move(assembled.free_rows);
  model.curved_elements = assembled.curved_elements;
  model.least_jacobian = assembled.least_jacobian;
  if (attachments.empty()) {
    model.free_motions = free_motions(model.nodes, fixed);
  } else {
    attach(model, fixed, attachments);
  }
  model.rigid_motions = static_cast<int>(model.free_motions.size());
  const auto of_nodes = static_cast<int>(3 * model.nodes.positions.rows());
  for (const int row : model.free_rows)
    model.node_of_row.push_back(row < of_nodes ? row / 3 : of_nodes / 3 + (row - of_nodes) / 6);
  return model;
}

Model build_model(mesh::TetMesh mesh, mesh::LagrangeNodes nodes, const Material& material,
                  const std::vector<int>& fixed, const Attachments& attachments) {
  return build_model(std::move(mesh), std::move(nodes), Materials{{material}, {}}, fixed, attachments);
}

Model build_model(mesh::TetMesh mesh, int order, const Material& material, const std::vector<int>& fixed,
                  const Attachments& attachments) {
  mesh::LagrangeNodes nodes = mesh::lagrange_nodes(mesh, order);
  return build_model(std::move(mesh), std::move(nodes), material, fixed, attachments);
}

Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> displacements(const Model& model,
                                                                        const Eigen::VectorXd& free) {
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> u(model.nodes.positions.rows(), 3);
  u.setZero();
  const std::size_t of_nodes = model.free_rows.size() - 6 * model.rigid.size();
  for (std::size_t i = 0; i < of_nodes; ++i)
    u(model.free_rows[i] / 3, model.free_rows[i] % 3) = free(static_cast<Eigen::Index>(i));
  for (std::size_t p = 0; p < model.rigid.size(); ++p) {
    const RigidPatch& patch = model.rigid[p];
    const Eigen::Matrix<double, 6, 1> q = free.segment<6>(static_cast<Eigen::Index>(of_nodes + 6 * p));
    for (const int node : patch.nodes) {
      const Eigen::Vector3d r = model.nodes.positions.row(node).transpose() - patch.centre_m;
      u.row(node) = (q.head<3>() + q.tail<3>().cross(r) / patch.size_m).transpose();
    }
  }
  return u;
}

Eigen::VectorXd on_rows(const Model& model,
                        const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>& displacements) {
  Eigen::VectorXd q(static_cast<Eigen::Index>(model.free_rows.size()));
  const std::size_t of_nodes = model.free_rows.size() - 6 * model.rigid.size();
  for (std::size_t i = 0; i < of_nodes; ++i)
    q(static_cast<Eigen::Index>(i)) = displacements(model.free_rows[i] / 3, model.free_rows[i] % 3);
  for (std::size_t p = 0; p < model.rigid.size(); ++p) {
    const RigidPatch& patch = model.rigid[p];
    const auto count = static_cast<Eigen::Index>(patch.nodes.size());
    Eigen::Matrix<double, Eigen::Dynamic, 6> R(3 * count, 6);
    Eigen::VectorXd u(3 * count);
    for (Eigen::Index a = 0; a < count; ++a) {
      const int node = patch.nodes[static_cast<std::size_t>(a)];
      const Eigen::Vector3d r = model.nodes.positions.row(node).transpose() - patch.centre_m;
      R.middleRows<3>(3 * a) << Eigen::Matrix3d::Identity(), -cross_matrix(r) / patch.size_m;
      u.segment<3>(3 * a) = displacements.row(node).transpose();
    }
    q.segment<6>(static_cast<Eigen::Index>(of_nodes + 6 * p)) = R.colPivHouseholderQr().solve(u);
  }
  return q;
}

Eigen::MatrixXd rigid_body_motions(const Model& model) {
  const Eigen::MatrixXd at_nodes = rigid_body_motions(model.nodes);
  Eigen::MatrixXd R(static_cast<Eigen::Index>(model.free_rows.size()), 6);
  for (Eigen::Index j = 0; j < 6; ++j)
    R.col(j) = on_rows(model, at_nodes.col(j).reshaped<Eigen::RowMajor>(model.nodes.positions.rows(), 3));
  return R;
}

std::vector<int> rows_of(const std::vector<int>& nodes, const std::vector<int>& axes) {
  std::vector<int> rows;
  for (const int node : nodes) {
    for (const int axis : axes) rows.push_back(3 * node + axis);
  }
  return rows;
}

namespace {

/// Throws MemoryLimitError with a proposal for a mesh that fits. The factor of a solid grows as nnz(L) ~ n^{4/3}
/// (George 1973), and n as h^{-3}: the size that fits follows.
[[noreturn]] void too_large(const Model& model, const linalg::MemoryLimitError& error) {
  const double fitting = std::pow(error.limit_bytes / error.needed_bytes, 0.75);
  const auto rounded = [](double x) { return std::to_string(static_cast<long>(std::lround(x))); };
  throw linalg::MemoryLimitError(std::string(error.what()) + ": about " +
                                     rounded(fitting * static_cast<double>(model.K.rows())) + " of these " +
                                     std::to_string(model.K.rows()) + " degrees of freedom fit; make the elements " +
                                     rounded(std::ceil(100.0 * (std::cbrt(1.0 / fitting) - 1.0))) +
                                     " % larger, lower the order, or give more by --memory",
                                 error.needed_bytes, error.limit_bytes);
}

/// The rows 3·node + axis that supports hold: those that are neither free nor part of a rigid patch.
std::vector<int> rows_held(const Model& model) {
  const RowMap rows = row_map(model.nodes.positions.rows(), model.free_rows, model.rigid);
  std::vector<int> held;
  for (std::size_t row = 0; row < rows.row_of.size(); ++row) {
    if (rows.row_of[row] < 0 && (rows.patch_of.empty() || rows.patch_of[row / 3] < 0))
      held.push_back(static_cast<int>(row));
  }
  return held;
}

/// True if only springs or clamps hold a rigid motion, with an eigenvalue λ below `bound`. λ is estimated from Rayleigh
/// quotients of the six rigid motions about the centre. K⁻¹ would then be dominated by these motions, so that a shift
/// is needed as for a free part.
bool softly_held(const Model& model, double bound) {
  if (model.nodes.positions.rows() == 0) return false;  // the model has matrices but no mesh
  if (free_motions(model.nodes, rows_held(model)).empty()) return false;
  Eigen::MatrixXd R = rigid_body_motions(model);
  R.rightCols<3>() += R.leftCols<3>() * cross_matrix(model.mass.centre_m);
  const Eigen::MatrixXd K = R.transpose() * (model.K * R);
  const Eigen::MatrixXd M = R.transpose() * (model.M * R);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> quotients(K, M, Eigen::EigenvaluesOnly);
  return quotients.eigenvalues().minCoeff() < bound;
}

}  // namespace

Factored factorise(const Model& model, double memory_limit_bytes) {
  const linalg::FactorOptions options{.memory_limit_bytes = memory_limit_bytes};
  try {
    const double sigma = -1e-8 * model.spectrum_rad2_s2;
    if (model.rigid_motions == 0 && !softly_held(model, -1e-3 * sigma))
      return {linalg::SparseCholesky(model.K, model.node_of_row, options), 0.0};
    return {linalg::SparseCholesky(model.K, -sigma, model.M, model.node_of_row, options), sigma};
  } catch (const linalg::MemoryLimitError& error) {
    too_large(model, error);
  }
}

linalg::ShiftedInverse inverse_of(const Factored& factored) {
  return {[&factored](const Eigen::Ref<const Eigen::MatrixXd>& B) { return factored.factor.solve(B); }, factored.sigma};
}

}  // namespace thinwall::fem

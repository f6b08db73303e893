#include "fem/model.hpp"

#include "core/error.hpp"

namespace thinwall::fem {

Model build_model(mesh::TetMesh mesh, int order, const Material& material, const std::vector<int>& fixed) {
  Model model;
  model.mesh = std::move(mesh);
  model.nodes = mesh::lagrange_nodes(model.mesh, order);
  const Assembled all = assemble(model.mesh, model.nodes, material);
  model.mass = mass_properties(all.M, model.nodes);
  model.rigid_motions = free_rigid_motions(model.nodes, fixed);
  std::vector<char> held(static_cast<std::size_t>(all.K.rows()), 0);
  for (const int row : fixed) held[static_cast<std::size_t>(row)] = 1;
  for (int row = 0; row < static_cast<int>(held.size()); ++row) {
    if (held[static_cast<std::size_t>(row)] != 0) continue;
    model.free_rows.push_back(row);
    model.node_of_row.push_back(row / 3);
  }
  if (model.free_rows.empty()) throw core::InputError("the supports hold every node of the part: nothing can move");
  model.K = linalg::restrict_to(all.K, model.free_rows);
  model.M = linalg::restrict_to(all.M, model.free_rows);
  return model;
}

Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> displacements(const Model& model,
                                                                        const Eigen::VectorXd& free) {
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> u(model.nodes.positions.rows(), 3);
  u.setZero();
  for (std::size_t i = 0; i < model.free_rows.size(); ++i)
    u(model.free_rows[i] / 3, model.free_rows[i] % 3) = free(static_cast<Eigen::Index>(i));
  return u;
}

std::vector<int> rows_of(const std::vector<int>& nodes, const std::vector<int>& axes) {
  std::vector<int> rows;
  for (const int node : nodes) {
    for (const int axis : axes) rows.push_back(3 * node + axis);
  }
  return rows;
}

Factored factorise(const Model& model) {
  if (model.rigid_motions == 0) return {linalg::SparseCholesky(model.K, model.node_of_row), 0.0};
  const double sigma = -1e-8 * model.K.diagonal().sum() / model.M.diagonal().sum();
  return {linalg::SparseCholesky(linalg::combine(1.0, model.K, -sigma, model.M), model.node_of_row), sigma};
}

linalg::ShiftedInverse inverse_of(const Factored& factored) {
  return {[&factored](const Eigen::Ref<const Eigen::MatrixXd>& B) { return factored.factor.solve(B); }, factored.sigma};
}

}  // namespace thinwall::fem

#include "fem/model.hpp"

#include "core/error.hpp"

namespace thinwall::fem {

Model build_model(mesh::TetMesh mesh, mesh::LagrangeNodes nodes, const Material& material,
                  const std::vector<int>& fixed) {
  Model model;
  model.mesh = std::move(mesh);
  model.nodes = std::move(nodes);
  Assembled assembled = assemble(model.nodes, material, fixed);
  model.mass = mass_properties(assembled.node_mass, model.nodes);
  model.rigid_motions = free_rigid_motions(model.nodes, fixed);
  model.K = std::move(assembled.K);
  model.M = std::move(assembled.M);
  model.free_rows = std::move(assembled.free_rows);
  for (const int row : model.free_rows) model.node_of_row.push_back(row / 3);
  model.curved_elements = assembled.curved_elements;
  model.least_jacobian = assembled.least_jacobian;
  return model;
}

Model build_model(mesh::TetMesh mesh, int order, const Material& material, const std::vector<int>& fixed) {
  mesh::LagrangeNodes nodes = mesh::lagrange_nodes(mesh, order);
  return build_model(std::move(mesh), std::move(nodes), material, fixed);
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

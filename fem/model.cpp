#include "fem/model.hpp"

#include <cmath>
#include <string>

#include "core/error.hpp"
#include "fem/free_motions.hpp"

namespace thinwall::fem {

Model build_model(mesh::TetMesh mesh, mesh::LagrangeNodes nodes, const Material& material,
                  const std::vector<int>& fixed) {
  Model model;
  model.mesh = std::move(mesh);
  model.nodes = std::move(nodes);
  Assembled assembled = assemble(model.nodes, material, fixed);
  model.mass = mass_properties(assembled.node_mass, model.nodes);
  model.free_motions = free_motions(model.nodes, fixed);
  model.rigid_motions = static_cast<int>(model.free_motions.size());
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

namespace {

/// nnz(L) of a solid grows as n^{4/3} (George 1973), n as h^{-3}: the size that fits follows.
[[noreturn]] void too_large(const Model& model, const linalg::MemoryLimitError& error) {
  const double fitting = std::pow(error.limit_bytes / error.needed_bytes, 0.75);
  const auto rounded = [](double x) { return std::to_string(static_cast<long>(std::lround(x))); };
  throw linalg::MemoryLimitError(
      std::string(error.what()) + ": about " + rounded(fitting * static_cast<double>(model.K.rows())) + " of these " +
          std::to_string(model.K.rows()) + " degrees of freedom fit; make the elements " +
          rounded(std::ceil(100.0 * (std::cbrt(1.0 / fitting) - 1.0))) + " % larger, or lower the order",
      error.needed_bytes, error.limit_bytes);
}

}  // namespace

Factored factorise(const Model& model, double memory_limit_bytes) {
  const linalg::FactorOptions options{.memory_limit_bytes = memory_limit_bytes};
  try {
    if (model.rigid_motions == 0) return {linalg::SparseCholesky(model.K, model.node_of_row, options), 0.0};
    const double sigma = -1e-8 * model.K.diagonal().sum() / model.M.diagonal().sum();
    return {linalg::SparseCholesky(linalg::combine(1.0, model.K, -sigma, model.M), model.node_of_row, options), sigma};
  } catch (const linalg::MemoryLimitError& error) {
    too_large(model, error);
  }
}

linalg::ShiftedInverse inverse_of(const Factored& factored) {
  return {[&factored](const Eigen::Ref<const Eigen::MatrixXd>& B) { return factored.factor.solve(B); }, factored.sigma};
}

}  // namespace thinwall::fem

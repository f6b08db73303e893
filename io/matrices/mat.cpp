#include "io/matrices/mat.hpp"

#include <string>
#include <vector>

#include "core/error.hpp"
#include "io/matrices/mat_variables.hpp"

namespace thinwall::io {

using dynamics::SpatialModel;

namespace {

SpatialModel model_in(const std::filesystem::path& path) {
  std::vector<std::string> names{"M", "C", "K", "D", "T"};
  for (const std::string& name : dof_variable_names("dof")) names.push_back(name);
  const MatVariables variables = read_mat_variables(path, names);
  SpatialModel model;
  model.M = matrix_of(variable(variables, "M", path), path);
  const Eigen::Index n = model.M.rows();
  if (model.M.cols() != n) throw core::DataError(path.string() + ": the variable M is not square");
  model.K = matrix_of(variable(variables, "K", path), path, n, n);
  model.C = variables.contains("C") ? matrix_of(variables.at("C"), path, n, n) : Eigen::MatrixXd::Zero(n, n);
  if (variables.contains("D")) model.D = matrix_of(variables.at("D"), path, n, n);
  if (variables.contains("T")) {
    model.T = matrix_of(variables.at("T"), path);
    if (model.T.cols() != n || model.T.rows() == 0) {
      throw core::DataError(path.string() + ": the variable T is " + std::to_string(model.T.rows()) + " x " +
                            std::to_string(model.T.cols()) + "; it must have a column for each of the " +
                            std::to_string(n) + " rows of M");
    }
  }
  model.dofs = dofs_of(variables, "dof", model.has_own_coordinates() ? model.T.rows() : n, path);
  return model;
}

}  // namespace

void write_mat(const std::filesystem::path& path, const SpatialModel& model) {
  dynamics::require_consistent(model);
  std::vector<MatVariable> variables{mat_matrix("M", model.M), mat_matrix("C", model.C), mat_matrix("K", model.K)};
  if (model.has_structural_damping()) variables.push_back(mat_matrix("D", model.D));
  if (model.has_own_coordinates()) variables.push_back(mat_matrix("T", model.T));
  for (MatVariable& table : dof_variables("dof", model.dofs)) variables.push_back(std::move(table));
  write_mat_variables(path, "reduced model by thinwall", variables);
}

SpatialModel read_mat(const std::filesystem::path& path) {
  return in_memory(path, [&] { return model_in(path); });
}

}  // namespace thinwall::io

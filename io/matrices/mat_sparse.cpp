#include "io/matrices/mat_sparse.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "dynamics/sparse_spatial.hpp"
#include "io/matrices/mat.hpp"
#include "io/matrices/mat_variables.hpp"

namespace thinwall::io {

namespace {

using dynamics::SparseModel;

template <class Values>
MatVariable column(const std::string& name, const Values& values) {
  return {name, {values.size(), 1}, {values.begin(), values.end()}};
}

std::vector<int> integers(const MatVariable& variable, const std::filesystem::path& path) {
  std::vector<int> result;
  for (const double value : variable.re) {
    if (value != std::floor(value) || std::abs(value) >= std::numeric_limits<int>::max())
      throw core::DataError(path.string() + ": the variable " + variable.name + " holds what is no number of a node");
    result.push_back(static_cast<int>(value));
  }
  return result;
}

void read_nodes(const MatVariables& variables, const std::filesystem::path& path, SparseModel& model) {
  if (variables.contains("node_number")) {
    const std::vector<int> nodes = integers(variables.at("node_number"), path);
    const Eigen::MatrixXd x = matrix_of(variable(variables, "node_position", path), path, std::ssize(nodes), 3);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      model.positions.emplace(nodes[i], x.row(static_cast<Eigen::Index>(i)).transpose());
  }
  if (variables.contains("name_number")) {
    const std::vector<int> nodes = integers(variables.at("name_number"), path);
    const MatVariable& names = variable(variables, "name_text", path);
    if (names.texts.size() != nodes.size())
      throw core::DataError(path.string() + ": the variable name_text has not as many rows as name_number");
    for (std::size_t i = 0; i < nodes.size(); ++i) model.names.emplace(nodes[i], names.texts[i]);
  }
}

/// True if a matrix is in a file of its own. Throws DataError if it is in the stiffness file too.
bool is_elsewhere(const MatVariables& variables, const std::string& name, const std::filesystem::path& path,
                  const std::filesystem::path& other) {
  if (other.empty() || other == path) return false;
  if (!variables.contains(name)) return true;
  throw core::DataError(path.string() + ": holds " + name + ", which " + other.string() +
                        " is stated for; leave it out of one of them");
}

SparseModel sparse_model_in(const MatFiles& files) {
  const std::filesystem::path& path = files.stiffness;
  const MatVariables variables = read_mat_variables(path, {"K", "M", "C", "dof_node", "dof_component", "dof_point",
                                                           "node_number", "node_position", "name_number", "name_text"});
  const bool other_mass = is_elsewhere(variables, "M", path, files.mass);
  const bool other_damping = is_elsewhere(variables, "C", path, files.damping);
  SparseModel model;
  if (variables.contains("dof_point")) {
    model = dynamics::sparse_model(read_mat(path));
    if (other_damping) model.C = read_mat_matrix(files.damping, "C");
    return model;
  }
  model.K = sparse_of(variable(variables, "K", path), path);
  model.M = other_mass ? read_mat_matrix(files.mass, "M") : sparse_of(variable(variables, "M", path), path);
  if (other_damping) model.C = read_mat_matrix(files.damping, "C");
  if (!other_damping && variables.contains("C")) model.C = sparse_of(variables.at("C"), path);
  if (variables.contains("dof_node")) {
    const std::vector<int> nodes = integers(variables.at("dof_node"), path);
    const std::vector<int> components = integers(variable(variables, "dof_component", path), path);
    if (nodes.size() != components.size())
      throw core::DataError(path.string() + ": the variables dof_node and dof_component differ in length");
    for (std::size_t i = 0; i < nodes.size(); ++i) model.dofs.push_back({nodes[i], components[i]});
  }
  read_nodes(variables, path, model);
  return model;
}

}  // namespace

void write_mat(const std::filesystem::path& path, const SparseModel& model) {
  dynamics::require_consistent(model);
  std::vector<MatVariable> variables{mat_sparse("K", model.K), mat_sparse("M", model.M)};
  if (model.has_damping()) variables.push_back(mat_sparse("C", model.C));
  std::vector<int> nodes, components;
  for (const dynamics::NodeDof& dof : model.dofs) {
    nodes.push_back(dof.node);
    components.push_back(dof.component);
  }
  variables.push_back(column("dof_node", nodes));
  variables.push_back(column("dof_component", components));
  if (!model.positions.empty()) {
    std::vector<int> numbers;
    Eigen::MatrixXd x(std::ssize(model.positions), 3);
    for (const auto& [node, position] : model.positions) {
      x.row(std::ssize(numbers)) = position.transpose();
      numbers.push_back(node);
    }
    variables.push_back(column("node_number", numbers));
    variables.push_back(mat_matrix("node_position", x));
  }
  if (!model.names.empty()) {
    std::vector<int> numbers;
    MatVariable texts{"name_text", {model.names.size(), 1}, {}};
    for (const auto& [node, name] : model.names) {
      numbers.push_back(node);
      texts.texts.push_back(name);
    }
    variables.push_back(column("name_number", numbers));
    variables.push_back(texts);
  }
  write_mat_variables(path, "component matrices by thinwall", variables);
}

Eigen::SparseMatrix<double> read_mat_matrix(const std::filesystem::path& path, const std::string& name) {
  return in_memory(path, [&] { return sparse_of(variable(read_mat_variables(path, {name}), name, path), path); });
}

SparseModel read_sparse_mat(const std::filesystem::path& path) {
  return read_sparse_mat(MatFiles{path});
}

SparseModel read_sparse_mat(const MatFiles& files) {
  return in_memory(files.stiffness, [&] { return sparse_model_in(files); });
}

}  // namespace thinwall::io

#include "io/matrices/superelement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/error.hpp"
#include "io/matrices/matrix_entries.hpp"
#include "io/matrices/netcdf.hpp"

namespace thinwall::io {

namespace {

using dynamics::SparseModel;

/// A file's bytes and the variables of its heading.
struct Source {
  std::string_view bytes;
  std::string path;
  std::vector<NetcdfVariable> variables;

  [[nodiscard]] const NetcdfVariable* find(std::string_view name) const { return find_variable(variables, name); }
  [[nodiscard]] std::vector<double> values(const NetcdfVariable& variable) const {
    return netcdf_values(bytes, variable, path);
  }
  [[noreturn]] void fail(const std::string& what) const { throw core::DataError(path + ": " + what); }
};

std::string names_in(const Source& source) {
  std::string names;
  for (const NetcdfVariable& variable : source.variables) names += (names.empty() ? "" : ", ") + variable.name;
  return names.empty() ? "none" : names;
}

/// The matrix of that name; 0 × 0 if the file has none and need not.
Eigen::SparseMatrix<double> matrix(const Source& source, const std::string& name, bool required) {
  const NetcdfVariable* variable = source.find(name);
  if (variable == nullptr && !required) return {};
  if (variable == nullptr)
    source.fail("has no variable " + name + ", which a superelement of Sierra/SD has; it has " + names_in(source));
  if (variable->size.size() != 2 || variable->size[0] != variable->size[1] || variable->size[0] > largest_label)
    source.fail("the variable " + name + " is no square matrix");
  const std::vector<double> values = source.values(*variable);
  const auto n = static_cast<Eigen::Index>(variable->size[0]);
  // The last dimension runs fastest: a row of the file is a row of the matrix.
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const Rows>(values.data(), n, n).sparseView(0.0, 0.0);
}

/// The variable as whole numbers of a label's size; nothing if the file has none.
std::vector<int> labels(const Source& source, const std::string& name) {
  const NetcdfVariable* variable = source.find(name);
  if (variable == nullptr) return {};
  std::vector<int> result;
  for (const double value : source.values(*variable)) {
    if (value != std::floor(value) || std::abs(value) > 0.5 * static_cast<double>(largest_label))
      source.fail("the variable " + name + " contains " + std::to_string(value) + ", which is no number of a node");
    result.push_back(static_cast<int>(value));
  }
  return result;
}

/// Numbers of the file's nodes in their order: those of node_num_map, or 1, 2 ….
std::vector<int> numbers_of_nodes(const Source& source, std::size_t count) {
  std::vector<int> numbers = labels(source, "node_num_map");
  if (numbers.empty())
    for (std::size_t i = 0; i < count; ++i) numbers.push_back(static_cast<int>(i) + 1);
  if (numbers.size() < count) source.fail("node_num_map has fewer numbers than there are positions of nodes");
  return numbers;
}

void read_positions(const Source& source, SparseModel& model) {
  std::array<std::vector<double>, 3> x;
  for (std::size_t i = 0; i < 3; ++i) {
    const NetcdfVariable* variable = source.find(std::array{"coordx", "coordy", "coordz"}[i]);
    if (variable == nullptr) return;
    x[i] = source.values(*variable);
    if (x[i].size() != x[0].size()) source.fail("the variables coordx, coordy and coordz differ in length");
  }
  const std::vector<int> numbers = numbers_of_nodes(source, x[0].size());
  for (std::size_t i = 0; i < x[0].size(); ++i)
    model.positions.emplace(numbers[i], Eigen::Vector3d(x[0][i], x[1][i], x[2][i]));
}

/// Turns places in node_num_map, from 1, into its numbers, unless all of the nodes are numbers of it.
void number_nodes(const Source& source, std::vector<int>& nodes) {
  const std::vector<int> numbers = labels(source, "node_num_map");
  const std::set<int> known(numbers.begin(), numbers.end());
  const auto is_mode = [](int node) { return node <= 0; };
  if (numbers.empty() || std::ranges::all_of(nodes, [&](int n) { return is_mode(n) || known.contains(n); })) return;
  for (int& node : nodes) {
    if (is_mode(node)) continue;
    if (node > std::ssize(numbers))
      source.fail("cbmap names node " + std::to_string(node) +
                  ", which is neither a number nor a place of node_num_map");
    node = numbers[static_cast<std::size_t>(node) - 1];
  }
}

std::vector<dynamics::NodeDof> dofs_of(const Source& source, std::size_t count) {
  const NetcdfVariable* variable = source.find("cbmap");
  if (variable == nullptr || count == 0) return {};
  if (variable->size != std::vector<std::int64_t>{static_cast<std::int64_t>(count), 2}) {
    std::string shape;
    for (const std::int64_t length : variable->size) shape += (shape.empty() ? "" : " x ") + std::to_string(length);
    source.fail("the variable cbmap is " + (shape.empty() ? "one number" : shape) + ", not " + std::to_string(count) +
                " x 2: node and component of each row of Kr");
  }
  const std::vector<int> map = labels(source, "cbmap");
  std::vector<int> nodes;
  for (std::size_t i = 0; i < count; ++i) nodes.push_back(map[2 * i]);
  number_nodes(source, nodes);
  int next_mode = std::max(0, *std::ranges::max_element(nodes));
  for (const int number : labels(source, "node_num_map")) next_mode = std::max(next_mode, number);
  std::vector<dynamics::NodeDof> dofs;
  for (std::size_t i = 0; i < count; ++i) {
    const int component = map[2 * i + 1];
    if (nodes[i] > 0 && (component < 1 || component > 6))
      source.fail("cbmap names component " + std::to_string(component) + " of node " + std::to_string(nodes[i]) +
                  "; components are 1 to 6");
    dofs.push_back(nodes[i] > 0 ? dynamics::NodeDof{nodes[i], component} : dynamics::NodeDof{++next_mode, 0});
  }
  return dofs;
}

}  // namespace

SparseModel read_superelement(std::string_view bytes, const std::string& path) {
  const Source source{bytes, path, netcdf_variables(bytes, path)};
  SparseModel model;
  model.K = matrix(source, "Kr", true);
  model.M = matrix(source, "Mr", true);
  model.C = matrix(source, "Cr", false);
  model.dofs = dofs_of(source, static_cast<std::size_t>(model.K.rows()));
  read_positions(source, model);
  return model;
}

}  // namespace thinwall::io

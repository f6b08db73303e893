#include "io/matrices/dof_table_csv.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "io/csv_text.hpp"
#include "io/mesh/inp_text.hpp"
#include "io/surface_text.hpp"
#include "mesh/solid/labelled_checks.hpp"

namespace thinwall::io {

namespace {

using dynamics::NodeDof;

constexpr std::array component_words{"mode", "x", "y", "z", "rx", "ry", "rz"};

[[noreturn]] void fail(const CsvText& text, const CsvLine& line, const std::string& what) {
  throw core::DataError(location(text, line) + ": " + what);
}

/// The numbers of the columns of these names; −1 for a name that does not occur.
std::vector<int> columns_of(const CsvText& text, const std::vector<std::string>& names, std::size_t needed) {
  std::vector<int> columns(names.size(), -1);
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ",") + name;
  for (std::size_t i = 0; i < text.header.size(); ++i) {
    const auto found = std::find(names.begin(), names.end(), lower_case(text.header[i]));
    if (found == names.end() || columns[static_cast<std::size_t>(found - names.begin())] >= 0) {
      throw core::DataError(text.path.string() + ": the column " + io::quoted(text.header[i]) +
                            " is not known, or is there twice; columns are " + list);
    }
    columns[static_cast<std::size_t>(found - names.begin())] = static_cast<int>(i);
  }
  for (std::size_t i = 0; i < needed; ++i) {
    if (columns[i] >= 0) continue;
    throw core::DataError(text.path.string() + ": has no column \"" + names[i] +
                          "\"; the first line names the columns: " + list);
  }
  require_columns(text, text.header.size(), list);
  return columns;
}

int whole(const CsvText& text, const CsvLine& line, int column, double least) {
  const double value = number(text, line, static_cast<std::size_t>(column));
  if (value == std::floor(value) && value >= least && std::abs(value) < std::numeric_limits<int>::max())
    return static_cast<int>(value);
  fail(text, line,
       "column " + std::to_string(column + 1) + ": " + io::quoted(line.fields[static_cast<std::size_t>(column)]) +
           " is not the number of a row or node");
}

int component(const CsvText& text, const CsvLine& line, int column) {
  const std::string word = lower_case(line.fields[static_cast<std::size_t>(column)]);
  for (std::size_t i = 0; i < component_words.size(); ++i)
    if (word == component_words[i] || word == std::to_string(i)) return static_cast<int>(i);
  fail(text, line, "the component is " + io::quoted(word) + "; 1 to 6, or x, y, z, rx, ry, rz; 0 or \"mode\"");
}

void take_name(const CsvText& text, const CsvLine& line, int column, int node, DofTableFile& table) {
  const std::string& point = line.fields[static_cast<std::size_t>(column)];
  if (point.empty()) return;
  const auto [known, is_new] = table.names.emplace(node, point);
  if (!is_new && known->second != point)
    fail(text, line,
         "node " + std::to_string(node) + " is called " + io::quoted(known->second) + " and " + io::quoted(point));
}

void take_position(const CsvText& text, const CsvLine& line, const std::array<int, 3>& columns, int node,
                   std::map<int, Eigen::Vector3d>& positions) {
  Eigen::Vector3d x;
  const auto is_empty = [&](int column) { return line.fields[static_cast<std::size_t>(column)].empty(); };
  if (std::all_of(columns.begin(), columns.end(), is_empty)) return;
  for (std::size_t k = 0; k < 3; ++k)
    x(static_cast<Eigen::Index>(k)) = number(text, line, static_cast<std::size_t>(columns[k]));
  const auto [known, is_new] = positions.emplace(node, x);
  if (!is_new && known->second != x) fail(text, line, "node " + std::to_string(node) + " has two positions");
}

/// The lines in the order of their row numbers. Throws DataError unless these are 1, 2 … in any order, each once.
std::vector<std::size_t> order_of(const CsvText& text, int column) {
  std::vector<std::size_t> order(text.lines.size(), text.lines.size());
  for (std::size_t i = 0; i < text.lines.size(); ++i) {
    const auto row = column < 0 ? i + 1 : static_cast<std::size_t>(whole(text, text.lines[i], column, 1.0));
    if (row > order.size()) {
      fail(text, text.lines[i],
           "row " + std::to_string(row) + ", but the table has " + std::to_string(order.size()) + ": one is left out");
    }
    if (order[row - 1] < order.size()) fail(text, text.lines[i], "row " + std::to_string(row) + " is there twice");
    order[row - 1] = i;
  }
  return order;
}

}  // namespace

DofTableFile read_dof_table(const std::filesystem::path& path) {
  const CsvText text = read_csv_text(path);
  const std::vector<int> at = columns_of(text, {"node", "component", "row", "point", "x_m", "y_m", "z_m"}, 2);
  const std::array<int, 3> coordinates{at[4], at[5], at[6]};
  const auto stated = std::count_if(coordinates.begin(), coordinates.end(), [](int column) { return column >= 0; });
  if (stated % 3 != 0) throw core::DataError(path.string() + ": of x_m, y_m, z_m some are missing");
  DofTableFile table;
  for (const std::size_t i : order_of(text, at[2])) {
    const CsvLine& line = text.lines[i];
    const NodeDof dof{whole(text, line, at[0], -2147483647.0), component(text, line, at[1])};
    if (at[3] >= 0) take_name(text, line, at[3], dof.node, table);
    if (stated == 3) take_position(text, line, coordinates, dof.node, table.positions_m);
    table.dofs.push_back(dof);
  }
  return table;
}

void write_dof_table(const std::filesystem::path& path, const dynamics::SparseModel& model) {
  std::string content = "row,node,component,point,x_m,y_m,z_m\n";
  for (std::size_t i = 0; i < model.dofs.size(); ++i) {
    const NodeDof& dof = model.dofs[i];
    const auto name = model.names.find(dof.node);
    const auto position = model.positions.find(dof.node);
    if (position != model.positions.end() && !position->second.allFinite()) {
      throw core::InputError(path.string() + ": the position of node " + std::to_string(dof.node) +
                             " is not finite; leave it out where it is not known");
    }
    content += std::to_string(i + 1) + ',' + std::to_string(dof.node) + ',' +
               component_words.at(static_cast<std::size_t>(dof.component)) + ',' +
               (name == model.names.end() ? "" : csv_field(name->second));
    for (Eigen::Index k = 0; k < 3; ++k)
      content += ',' + (position == model.positions.end() ? "" : core::number_text(position->second(k)));
    content += '\n';
  }
  core::write_file_atomically(path, content);
}

std::map<int, Eigen::Vector3d> read_node_positions(const std::filesystem::path& path) {
  std::map<int, Eigen::Vector3d> positions;
  if (lower_case(path.extension().string()) == ".inp") {
    InpText text = inp_text(core::read_file(path), path.string(), 1.0, included_file);
    mesh::sort_nodes(text.mesh);
    if (text.mesh.nodes.empty()) mesh::fail_at(text.mesh, 0, "holds no *NODE");
    for (const mesh::LabelledNode& node : text.mesh.nodes) positions.emplace(static_cast<int>(node.label), node.x);
    return positions;
  }
  const CsvText text = read_csv_text(path);
  const std::vector<int> at = columns_of(text, {"node", "x", "y", "z"}, 4);
  for (const CsvLine& line : text.lines)
    take_position(text, line, {at[1], at[2], at[3]}, whole(text, line, at[0], -2147483647.0), positions);
  return positions;
}

}  // namespace thinwall::io

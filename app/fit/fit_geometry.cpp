#include "app/fit/fit_geometry.hpp"

#include <cmath>

#include "core/error.hpp"
#include "io/frf/uff_mesh.hpp"
#include "io/results/csv_table.hpp"
#include "setup/measured.hpp"

namespace thinwall::app {

namespace {

std::string node_name(long node) {
  return "node " + std::to_string(node);
}

report::TestGeometry of_universal_file(const std::string& file) {
  report::TestGeometry geometry;
  const io::UffMesh mesh = io::read_uff_mesh(file);
  for (const io::UffNode& node : mesh.nodes) geometry.position[node_name(node.label)] = node.position;
  for (const io::UffTraceLine& line : mesh.lines) {
    for (std::size_t i = 1; i < line.nodes.size(); ++i) {
      if (line.nodes[i - 1] != 0 && line.nodes[i] != 0)
        geometry.lines.emplace_back(node_name(line.nodes[i - 1]), node_name(line.nodes[i]));
    }
  }
  return geometry;
}

report::TestGeometry of_table(const std::string& file) {
  const io::Table table = io::read_csv(file);
  const auto &x = io::numbers(table, "x_m", file), &y = io::numbers(table, "y_m", file),
             &z = io::numbers(table, "z_m", file);
  report::TestGeometry geometry;
  for (const io::Column& column : table) {
    if (column.name != "point") continue;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const auto* words = std::get_if<std::vector<std::string>>(&column.values);
      const std::string name =
          words != nullptr ? (*words)[i] : std::to_string(std::lround(std::get<std::vector<double>>(column.values)[i]));
      geometry.position[name] = {x[i], y[i], z[i]};
    }
    return geometry;
  }
  throw core::DataError(file + ": has no column point; write point,x_m,y_m,z_m");
}

}  // namespace

report::TestGeometry test_geometry(const std::string& file, const std::vector<std::string>& measured,
                                   std::vector<std::string>& notes) {
  const auto is_universal = [](const std::string& name) {
    return setup::frf_file_kind(name) == setup::FrfFileKind::universal;
  };
  if (!file.empty()) return is_universal(file) ? of_universal_file(file) : of_table(file);
  for (const std::string& name : measured) {
    if (!is_universal(name) || !io::has_uff_nodes(name)) continue;
    try {
      return of_universal_file(name);
    } catch (const core::DataError& error) {
      notes.push_back(std::string("no shapes are drawn on the nodes of a file, for they cannot be read: ") +
                      error.what() + "; mend them, or name another file by --geometry");
    }
  }
  return {};
}

}  // namespace thinwall::app

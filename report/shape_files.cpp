#include "report/shape_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "dynamics/mac.hpp"
#include "io/results/csv_table.hpp"
#include "io/results/pvd.hpp"
#include "io/results/vtp.hpp"
#include "io/results/vtu.hpp"
#include "mesh/solid/tessellation.hpp"
#include "report/coupled_shapes.hpp"
#include "report/test_shapes.hpp"
#include "setup/imported_part.hpp"
#include "setup/part_geometry.hpp"
#include "study/part/discretisation.hpp"
#include "study/part/part_damping.hpp"

namespace thinwall::report {

namespace {

namespace fs = std::filesystem;

/// The factor by which a viewer may show displacements whose largest is 1, such as ParaView's Warp By Vector: a
/// twentieth of the part's diagonal, m.
io::FieldNumber warp_factor(const fem::Model& model) {
  const auto& places = model.nodes.positions;
  return {"warp_factor", 0.05 * (places.colwise().maxCoeff() - places.colwise().minCoeff()).norm()};
}

/// One shape a file, and the collection that names them in order.
struct ShapeSeries {
  fs::path folder;
  std::string stem;  ///< "part_mode", "coupled_mode"
  std::vector<io::PvdEntry> entries;

  /// `shape` is over the free rows of the model, computed when its file is written; `values` are written with it.
  void add(FileTasks& files, const fem::Model& model, const std::function<Eigen::VectorXd()>& shape,
           std::vector<io::FieldNumber> values) {
    const std::size_t number = entries.size() + 1;
    const std::string name = fmt::format("{}_{:02}.vtu", stem, number);
    std::erase_if(values, [](const io::FieldNumber& value) { return std::isnan(value.value); });
    values.push_back(warp_factor(model));
    files.emplace_back([path = folder / name, &model, shape, values] {
      io::write_vtu(path, model.nodes, {{"displacement", fem::displacements(model, shape())}}, values);
    });
    entries.push_back({static_cast<double>(number), name});
  }
};

using Triangles = std::vector<std::array<int, 3>>;

/// 1 for the triangles whose nodes are all among `nodes`.
std::vector<double> covered(const std::vector<bool>& nodes, const Triangles& triangles) {
  std::vector<double> result;
  for (const auto& t : triangles)
    result.push_back(std::ranges::all_of(t, [&](int node) { return nodes[static_cast<std::size_t>(node)]; }) ? 1.0
                                                                                                             : 0.0);
  return result;
}

/// Nodes that are held in some direction.
std::vector<bool> held_nodes(const fem::Model& model) {
  std::vector<int> free(static_cast<std::size_t>(model.nodes.positions.rows()), 0);
  for (const int row : model.free_rows) {
    if (static_cast<std::size_t>(row) < 3 * free.size()) ++free[static_cast<std::size_t>(row / 3)];
  }
  for (const auto& patch : model.rigid)
    for (const int node : patch.nodes) free[static_cast<std::size_t>(node)] = 3;
  std::vector<bool> held;
  held.reserve(free.size());
  for (const int count : free) held.push_back(count < 3);
  return held;
}

/// Nodes that supports of that name hold; those on sets of nodes are looked up in the part's file.
std::vector<bool> nodes_held_by(const std::string& name, const setup::Setup& source, const fem::Model& model) {
  setup::Setup one = source;
  std::erase_if(one.part->supports, [&](const setup::Support& support) { return support.on != name; });
  std::vector<int> rows = fem::fixed_rows(model.mesh, model.nodes, setup::supports_of(one));
  if (setup::names_node_set(source, name)) {
    mesh::SolidMesh solid = *setup::solid_of(*source.part);
    if (model.nodes.order == 2) solid = mesh::with_order(std::move(solid), 2);
    rows = setup::rows_held_by_sets(one, solid, model.nodes);
  }
  std::vector<bool> held(static_cast<std::size_t>(model.nodes.positions.rows()), false);
  for (const int row : rows) held[static_cast<std::size_t>(row / 3)] = true;
  return held;
}

/// Fields on the triangles of the surface: "held", the same of each support ("held by y_min"), the wall's
/// thickness.
std::vector<io::TriangleNumbers> fields(const setup::Setup& source, const study::PartResult& part,
                                        const Triangles& triangles) {
  std::vector<io::TriangleNumbers> numbers{{"held", covered(held_nodes(part.model), triangles)}};
  std::vector<std::string> names;
  for (const setup::Support& support : source.part->supports) {
    if (std::ranges::count(names, support.on) == 0) names.push_back(support.on);
  }
  for (const std::string& name : names)
    numbers.push_back({"held by " + name, covered(nodes_held_by(name, source, part.model), triangles)});
  if (part.wall_thickness_m.size() == triangles.size()) numbers.push_back({"wall_thickness_m", part.wall_thickness_m});
  return numbers;
}

/// The surface with all shapes as fields "mode 01, 160.7 Hz": what a viewer that knows no high orders can show; with
/// fields() of a case.
void write_surface(const fs::path& file, const study::PartResult& part, const Eigen::MatrixXd& shapes,
                   const std::vector<double>& hz, const setup::Setup* fields_of) {
  const fem::Model& model = part.model;
  std::vector<io::NodeVectors> vectors;
  for (std::size_t k = 0; k < hz.size(); ++k)
    vectors.push_back({fmt::format("mode {:02}, {:.1f} Hz", k + 1, hz[k]),
                       fem::displacements(model, shapes.col(static_cast<Eigen::Index>(k)))});
  const Triangles triangles = mesh::surface_triangles(model.nodes, mesh::boundary(model.mesh));
  const auto numbers = fields_of != nullptr ? fields(*fields_of, part, triangles) : std::vector<io::TriangleNumbers>{};
  io::write_vtp(file, model.nodes, triangles, vectors, numbers, {warp_factor(model)});
}

/// A matrix of likenesses as a table: a row for each mode of the part.
void write_mac(const fs::path& file, const Eigen::MatrixXd& values, const std::string& columns) {
  io::Table table;
  std::vector<double> number;
  for (Eigen::Index i = 0; i < values.rows(); ++i) number.push_back(static_cast<double>(i + 1));
  table.push_back({"part_mode", number});
  for (Eigen::Index j = 0; j < values.cols(); ++j)
    table.push_back(
        {fmt::format("{}_{}", columns, j + 1), std::vector<double>(values.col(j).begin(), values.col(j).end())});
  io::write_csv(file, table,
                {"modal assurance criterion (docs/notation.md), displacements of all free nodes; 0 of a mode of the "
                 "robot in which the part is at rest"});
}

/// Mass-normalised shapes in the scale in which they are drawn: the largest entry of each is 1.
Eigen::MatrixXd drawn(Eigen::MatrixXd shapes) {
  for (Eigen::Index k = 0; k < shapes.cols(); ++k) {
    const double largest = shapes.col(k).cwiseAbs().maxCoeff();
    if (largest > 0.0) shapes.col(k) /= largest;
  }
  return shapes;
}

/// The modal mass of a mass-normalised shape in the scale in which it is drawn, kg.
double modal_mass(const Eigen::VectorXd& shape) {
  const double largest = shape.cwiseAbs().maxCoeff();
  return largest > 0.0 ? 1.0 / (largest * largest) : 0.0;
}

void write_part_modes(FileTasks& files, const fs::path& folder, const setup::Setup& source,
                      const study::Results& results) {
  const study::PartResult& part = *results.finite_elements;
  const bool meshed = !part.model.mesh.tets.empty();
  ShapeSeries series{folder, "part_mode", {}};
  const auto shapes = std::make_shared<const Eigen::MatrixXd>(drawn(part.modes.pairs.Phi));
  const std::vector<double> damping = study::part_damping_ratios(results);
  std::vector<double> number, frequency, residual, mass;
  for (Eigen::Index k = 0; k < part.modes.frequency_hz.size(); ++k) {
    const double zeta = damping[static_cast<std::size_t>(k)];
    const auto shape = [shapes, k]() -> Eigen::VectorXd { return shapes->col(k); };
    mass.push_back(modal_mass(part.modes.pairs.Phi.col(k)));
    if (meshed) {
      series.add(
          files, part.model, shape,
          {{"frequency_hz", part.modes.frequency_hz(k)}, {"damping_ratio", zeta}, {"modal_mass_kg", mass.back()}});
    }
    number.push_back(static_cast<double>(k + 1));
    frequency.push_back(part.modes.frequency_hz(k));
    residual.push_back(part.modes.residual(k));
  }
  if (meshed) {
    io::write_pvd(folder / "part.pvd", series.entries);
    files.emplace_back([path = folder / "part_surface.vtp", &source, &part, shapes, frequency] {
      write_surface(path, part, *shapes, frequency, &source);
    });
    files.emplace_back([path = folder / "part.uff", &part, shapes, frequency, damping, mass] {
      write_test_shapes(path, part, *shapes, {frequency, damping, mass});
    });
  }
  io::write_csv(folder / "modes.csv", {{"mode", number},
                                       {"frequency_hz", frequency},
                                       {"damping_ratio", damping, true},
                                       {"relative_residual", residual}});
  write_mac(folder / "auto_mac.csv", dynamics::mac(part.modes.pairs.Phi, part.modes.pairs.Phi), "part_mode");
}

void write_coupled_modes(FileTasks& files, const fs::path& folder, const setup::Setup& source,
                         const study::Results& results) {
  const study::PartResult& part = *results.finite_elements;
  const auto shapes = std::make_shared<const CoupledShapes>(coupled_shapes(source, part, *results.coupled));
  const bool meshed = !part.model.mesh.tets.empty();
  ShapeSeries series{folder, "coupled_mode", {}};
  io::Table table{{"mode", std::vector<double>{}},
                  {"frequency_hz", shapes->frequency_hz},
                  {"damping_ratio", shapes->damping_ratio}};
  auto& number = std::get<std::vector<double>>(table.front().values);
  for (std::size_t k = 0; k < shapes->frequency_hz.size(); ++k) {
    const auto shape = [shapes, k]() -> Eigen::VectorXd { return shapes->part.col(static_cast<Eigen::Index>(k)); };
    if (meshed) {
      series.add(files, part.model, shape,
                 {{"frequency_hz", shapes->frequency_hz[k]}, {"damping_ratio", shapes->damping_ratio[k]}});
    }
    number.push_back(static_cast<double>(k + 1));
  }
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::RowVectorXd robot = shapes->robot.row(axis);
    table.push_back({std::string("robot_") + "xyz"[axis], std::vector<double>(robot.begin(), robot.end())});
  }
  if (meshed) {
    io::write_pvd(folder / "coupled.pvd", series.entries);
    files.emplace_back([path = folder / "coupled_surface.vtp", &part, shapes] {
      write_surface(path, part, shapes->part, shapes->frequency_hz, nullptr);
    });
    files.emplace_back([path = folder / "coupled.uff", &part, shapes] {
      write_test_shapes(path, part, shapes->part, {shapes->frequency_hz, shapes->damping_ratio});
    });
  }
  io::write_csv(folder / "coupled_modes.csv", table,
                {"robot_x, robot_y, robot_z: the robot's end where the largest displacement of part and robot is 1"});
  write_mac(folder / "mac.csv", dynamics::mac(part.modes.pairs.Phi, shapes->part), "coupled_mode");
}

}  // namespace

void write_shapes(FileTasks& files, const fs::path& folder, const setup::Setup& source, const study::Results& results) {
  write_part_modes(files, folder, source, results);
  if (results.coupled && results.coupled->modal) write_coupled_modes(files, folder, source, results);
}

}  // namespace thinwall::report

#include "report/page/shapes_data.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "io/results/csv_table.hpp"
#include "io/results/vtp.hpp"
#include "report/page/arrays.hpp"
#include "report/page/surface.hpp"
#include "report/summary/write_json.hpp"

namespace thinwall::report {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

json list(const Eigen::RowVectorXd& values) {
  return std::vector<double>(values.begin(), values.end());
}

std::vector<double> column(const fs::path& file, const std::string& name) {
  return io::numbers(io::read_csv(file), name, file);
}

/// Displacements of the robot's end, a row a mode; no rows where the table has none.
Eigen::MatrixX3d robot_of(const io::Table& table, const fs::path& file) {
  if (std::ranges::count(table, "robot_x", &io::Column::name) == 0) return {};
  Eigen::MatrixX3d end(std::ssize(io::numbers(table, "robot_x", file)), 3);
  for (const int axis : {0, 1, 2})
    end.col(axis) =
        Eigen::VectorXd::Map(io::numbers(table, std::string("robot_") + "xyz"[axis], file).data(), end.rows());
  return end;
}

/// The shapes of one file of surface fields; `of` and the table say what they are. The largest displacement of part and
/// robot becomes 1.
void add_modes(json& modes, const std::string& of, const io::SurfaceFields& fields, const Thinned& thin,
               const fs::path& file) {
  const io::Table table = io::read_csv(file);
  const auto& hz = io::numbers(table, "frequency_hz", file);
  const auto damping = io::numbers_or_gaps(table, "damping_ratio", file);
  const Eigen::MatrixX3d robot = robot_of(table, file);
  if (fields.vectors.size() != hz.size()) {
    throw core::DataError(file.string() + ": " + std::to_string(hz.size()) + " modes, their surface has " +
                          std::to_string(fields.vectors.size()) + "; the files are of different runs");
  }
  for (std::size_t k = 0; k < hz.size(); ++k) {
    const Eigen::MatrixXd all = fields.vectors[k].values;
    const auto row = static_cast<Eigen::Index>(k);
    const double of_robot = robot.rows() > 0 ? robot.row(row).norm() : 0.0;
    const double largest = std::max(all.rowwise().norm().maxCoeff(), of_robot);
    const double scale = largest > 0.0 ? 1.0 / largest : 1.0;
    const Quantised shape = quantised(scale * all(thin.vertices, Eigen::all), 2000, false);
    json mode = {{"of", of}, {"number", k + 1}, {"hz", hz[k]}, {"step", shape.step}};
    mode["damping"] = std::isnan(damping[k]) ? json(nullptr) : json(damping[k]);
    mode["shape"] = packed(shape.numbers, {thin.vertices.size(), 3});
    if (robot.rows() > 0) mode["robot"] = list(scale * robot.row(row));
    modes.push_back(std::move(mode));
  }
}

void add_fixture(json& shapes, const std::string& name, const io::TriangleNumbers& field, const Thinned& thin) {
  std::vector<std::uint32_t> held;
  for (std::size_t t = 0; t < thin.of_triangle.size(); ++t) {
    if (field.values[static_cast<std::size_t>(thin.of_triangle[t])] > 0.5)
      held.push_back(static_cast<std::uint32_t>(t));
  }
  if (!held.empty()) shapes["fixtures"].push_back({{"name", name}, {"triangles", packed(held, {held.size()})}});
}

/// Fields of the triangles that are left: which are held by which support, and how thick the wall is beneath them.
void add_triangle_fields(json& shapes, const io::SurfaceFields& fields, const Thinned& thin) {
  const std::string held_by = "held by ";
  for (const io::TriangleNumbers& field : fields.numbers) {
    if (field.name.starts_with(held_by)) add_fixture(shapes, field.name.substr(held_by.size()), field, thin);
    if (field.name != "wall_thickness_m") continue;
    std::vector<float> thickness;
    for (const int t : thin.of_triangle)
      thickness.push_back(for_picture(field.values[static_cast<std::size_t>(t)], 10));
    shapes["thickness_m"] = packed(thickness, {thickness.size()});
  }
}

json surface_of(const io::SurfaceFields& fields, const Thinned& thin) {
  Eigen::MatrixXd places(std::ssize(thin.vertices), 3);
  for (std::size_t v = 0; v < thin.vertices.size(); ++v)
    places.row(static_cast<Eigen::Index>(v)) = fields.surface.vertices[static_cast<std::size_t>(thin.vertices[v])];
  const Quantised grid = quantised(places, 32000, true);
  std::vector<std::uint32_t> corners;
  for (const auto& t : thin.triangles)
    for (const int v : t) corners.push_back(static_cast<std::uint32_t>(v));
  json shapes = {{"vertices", packed(grid.numbers, {thin.vertices.size(), 3})},
                 {"origin_m", list(grid.origin)},
                 {"step_m", grid.step},
                 {"triangles", packed(corners, {thin.triangles.size(), 3})},
                 {"thinned", nullptr},
                 {"modes", json::array()},
                 {"fixtures", json::array()}};
  if (thin.vertices.size() < fields.surface.vertices.size())
    shapes["thinned"] = {{"from", fields.surface.vertices.size()}, {"to", thin.vertices.size()}};
  return shapes;
}

json shapes_of(const fs::path& folder, const Summary& summary, std::size_t most_vectors) {
  const io::SurfaceFields part = io::read_vtp(folder / "part_surface.vtp");
  const fs::path coupled_file = folder / "coupled_surface.vtp";
  io::SurfaceFields coupled;
  if (fs::exists(coupled_file)) coupled = io::read_vtp(coupled_file);
  const std::size_t modes = std::max<std::size_t>(1, part.vectors.size() + coupled.vectors.size());
  const Thinned thin = thinned(part.surface, std::min<std::size_t>(60000, most_vectors / modes));
  json shapes = surface_of(part, thin);
  add_modes(shapes["modes"], "part", part, thin, folder / "modes.csv");
  if (coupled.surface.vertices.size() == part.surface.vertices.size())
    add_modes(shapes["modes"], "coupled", coupled, thin, folder / "coupled_modes.csv");
  add_triangle_fields(shapes, part, thin);
  shapes["points"] = json_of(summary.points);
  if (summary.robot && summary.robot->posture.arm_m) shapes["robot_arm"] = json_of(*summary.robot->posture.arm_m);
  return shapes;
}

/// The table of likenesses; a row for each mode of the part.
json likeness(const fs::path& file, const fs::path& columns) {
  const io::Table table = io::read_csv(file);
  const std::size_t rows = io::numbers(table, "part_mode", file).size(), width = table.size() - 1;
  std::vector<float> values(rows * width);
  for (std::size_t j = 0; j < width; ++j) {
    const auto& likenesses = io::numbers(table, table[j + 1].name, file);
    for (std::size_t i = 0; i < rows; ++i) values[i * width + j] = for_picture(likenesses[i]);
  }
  return {{"values", packed(values, {rows, width})},
          {"row_hz", column(file.parent_path() / "modes.csv", "frequency_hz")},
          {"column_hz", column(columns, "frequency_hz")},
          {"rows", "part alone"},
          {"columns", "part with robot"}};
}

}  // namespace

json shapes_data(const fs::path& results, const Summary& summary, std::size_t most_vectors) {
  const fs::path folder = results / "modes";
  json run = json::object();
  if (fs::exists(folder / "part_surface.vtp")) run["shapes"] = shapes_of(folder, summary, most_vectors);
  if (fs::exists(folder / "mac.csv")) run["mac"] = likeness(folder / "mac.csv", folder / "coupled_modes.csv");
  if (fs::exists(folder / "auto_mac.csv")) run["auto_mac"] = likeness(folder / "auto_mac.csv", folder / "modes.csv");
  if (summary.reduction) {
    json modes = json::array(), error = json::array();
    for (const ErrorBySizeSummary& step : summary.reduction->error_by_size) {
      modes.push_back(step.kept_modes);
      error.push_back(json_of(step.max_relative_frequency_error));
    }
    if (!modes.empty()) run["reduction_error"] = {{"modes", modes}, {"error", error}};
  }
  return run;
}

}  // namespace thinwall::report

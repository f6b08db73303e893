#include "app/result_files.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <numbers>

#include "app/case_writer.hpp"
#include "app/doctor.hpp"
#include "app/error_summary.hpp"
#include "app/imported_part.hpp"
#include "app/lobes_files.hpp"
#include "app/result_folder.hpp"
#include "app/robot_survey.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "io/csv_table.hpp"
#include "io/manifest.hpp"
#include "io/mat.hpp"
#include "io/pvd.hpp"
#include "io/response_csv.hpp"
#include "io/uff.hpp"
#include "io/vtp.hpp"
#include "io/vtu.hpp"
#include "mesh/tessellation.hpp"
#include "mesh/wall_thickness.hpp"

namespace thinwall::app {

namespace {

namespace fs = std::filesystem;

std::string numbered(const std::string& stem, std::size_t number) {
  char text[16];
  std::snprintf(text, sizeof text, "_%02zu", number);
  return stem + text;
}

/// Files to be written side by side, each by one call; what they refer to must outlive them.
using Files = std::vector<std::function<void()>>;

/// The part's own surface with the thickness of the wall beneath each triangle.
void write_wall_thickness(const fs::path& file, const mesh::TriangleSurface& surface) {
  io::write_vtp(file, surface, {{"wall_thickness_m", mesh::wall_thickness(surface, mesh::TriangleTree(surface))}});
}

/// One shape a file, and the collection that names them in order.
struct ShapeSeries {
  fs::path folder;
  std::string stem;  ///< "part_mode", "coupled_mode"
  std::vector<io::PvdEntry> entries;

  /// `shape` is over the free rows of the model, computed when its file is written.
  void add(Files& files, const fem::Model& model, const std::function<Eigen::VectorXd()>& shape, double frequency_hz,
           double damping_ratio) {
    const std::size_t number = entries.size() + 1;
    const std::string name = numbered(stem, number) + ".vtu";
    files.emplace_back([path = folder / name, &model, shape, frequency_hz, damping_ratio] {
      io::write_vtu(path, model.nodes, {{"displacement", fem::displacements(model, shape())}},
                    {{"frequency_hz", frequency_hz}, {"damping_ratio", damping_ratio}});
    });
    entries.push_back({static_cast<double>(number), name});
  }
};

/// The surface with all shapes as fields "mode 01, 160.7 Hz": what a viewer that knows no high orders can show.
void write_part_surface(const fs::path& file, const PartResult& part) {
  std::vector<io::NodeVectors> shapes;
  for (Eigen::Index k = 0; k < part.modes.frequency_hz.size(); ++k) {
    char name[48];
    std::snprintf(name, sizeof name, "mode %02d, %.1f Hz", static_cast<int>(k + 1), part.modes.frequency_hz(k));
    shapes.push_back({name, fem::displacements(part.model, part.modes.pairs.Phi.col(k))});
  }
  const auto& model = part.model;
  io::write_vtp(file, model.nodes, mesh::surface_triangles(model.nodes, mesh::boundary(model.mesh)), shapes);
}

void write_part_modes(Files& files, const fs::path& folder, const Results& results) {
  const PartResult& part = *results.finite_elements;
  const bool meshed = !part.model.mesh.tets.empty();
  ShapeSeries series{folder, "part_mode", {}};
  std::vector<double> ratios;
  if (results.part && results.part->modal) {
    for (const int k : dynamics::oscillating_modes(*results.part->modal))
      ratios.push_back(dynamics::summarise(results.part->modal->poles(k)).damping_ratio);
  }
  std::vector<double> number;
  std::vector<double> frequency;
  std::vector<double> damping;
  std::vector<double> residual;
  for (Eigen::Index k = 0; k < part.modes.frequency_hz.size(); ++k) {
    const auto elastic = static_cast<std::size_t>(std::max<Eigen::Index>(0, k - part.modes.rigid_motions));
    const double zeta = k >= part.modes.rigid_motions && elastic < ratios.size() ? ratios[elastic] : 0.0;
    const auto shape = [&part, k]() -> Eigen::VectorXd { return part.modes.pairs.Phi.col(k); };
    if (meshed) series.add(files, part.model, shape, part.modes.frequency_hz(k), zeta);
    number.push_back(static_cast<double>(k + 1));
    frequency.push_back(part.modes.frequency_hz(k));
    damping.push_back(zeta);
    residual.push_back(part.modes.residual(k));
  }
  if (meshed) {
    io::write_pvd(folder / "part.pvd", series.entries);
    files.emplace_back([path = folder / "part_surface.vtp", &part] { write_part_surface(path, part); });
  }
  io::write_csv(
      folder / "modes.csv",
      {{"mode", number}, {"frequency_hz", frequency}, {"damping_ratio", damping}, {"relative_residual", residual}});
}

/// Coupled shapes on the part's mesh: u = T_CB q with q the part's rows of a coupled mode, turned so that the largest
/// entry is real (a complex mode is drawn at the phase of its largest displacement).
void write_coupled_modes(Files& files, const fs::path& folder, const Results& results) {
  const PartResult& part = *results.finite_elements;
  const dynamics::ModalModel& modal = *results.coupled->modal;
  const Eigen::MatrixXd& T = part.reduced->T;
  const double highest = 2.0 * std::numbers::pi * part.modes.frequency_hz.maxCoeff();
  const bool meshed = !part.model.mesh.tets.empty();
  ShapeSeries series{folder, "coupled_mode", {}};
  std::vector<double> number;
  std::vector<double> frequency;
  std::vector<double> damping;
  for (const int k : dynamics::oscillating_modes(modal)) {
    if (std::abs(modal.poles(k)) > highest) break;
    Eigen::VectorXcd q = modal.right.col(k).head(T.cols());
    Eigen::Index largest = 0;
    q.cwiseAbs().maxCoeff(&largest);
    q *= std::conj(q(largest)) / std::abs(q(largest));
    const auto shape = [&T, q = Eigen::VectorXd(q.real())]() -> Eigen::VectorXd {
      const Eigen::VectorXd u = T * q;
      return u / u.cwiseAbs().maxCoeff();
    };
    const auto summary = dynamics::summarise(modal.poles(k));
    if (meshed) series.add(files, part.model, shape, summary.frequency_hz, summary.damping_ratio);
    number.push_back(static_cast<double>(number.size() + 1));
    frequency.push_back(summary.frequency_hz);
    damping.push_back(summary.damping_ratio);
  }
  if (meshed) io::write_pvd(folder / "coupled.pvd", series.entries);
  io::write_csv(folder / "coupled_modes.csv",
                {{"mode", number}, {"frequency_hz", frequency}, {"damping_ratio", damping}});
}

void write_frf(const fs::path& folder, const std::string& name, const dynamics::ResponseModel& response) {
  io::write_response(folder / (name + ".csv"), response);
  try {
    io::write_uff(folder / (name + ".uff"), response);
  } catch (const core::InputError& error) {
    // The format holds six digits of a frequency; a finer axis is in the CSV only.
    spdlog::warn("{}.uff was not written: {}", name, error.what());
  }
}

/// Only the DOFs of the points that the case wants written; all of a component of which it names none (the robot).
dynamics::ResponseModel at_points(const dynamics::ResponseModel& all, const std::vector<std::string>& points) {
  std::vector<Eigen::Index> kept;
  for (std::size_t i = 0; i < all.responses.size(); ++i) {
    if (std::find(points.begin(), points.end(), all.responses[i].point) != points.end())
      kept.push_back(static_cast<Eigen::Index>(i));
  }
  if (kept.empty() || kept.size() == all.responses.size()) return all;
  dynamics::ResponseModel chosen;
  chosen.axis = all.axis;
  for (const Eigen::Index i : kept) chosen.responses.push_back(all.responses[static_cast<std::size_t>(i)]);
  chosen.forces = chosen.responses;
  for (const auto& H : all.H) chosen.H.emplace_back(H(kept, kept));
  return chosen;
}

nlohmann::json records(const std::vector<io::FileRecord>& files) {
  nlohmann::json list = nlohmann::json::array();
  for (const auto& file : files) list.push_back({{"name", file.name}, {"bytes", file.bytes}, {"sha256", file.sha256}});
  return list;
}

}  // namespace

void write_results(const fs::path& folder, const Case& source, const Results& results) {
  for (const char* name : result_subfolders) fs::create_directories(folder / name);
  Files files;
  if (results.finite_elements) {
    write_part_modes(files, folder / "modes", results);
    if (results.coupled && results.coupled->modal) write_coupled_modes(files, folder / "modes", results);
    if (const auto& imported = source.part->imported; imported && imported->surface) {
      files.emplace_back([&surface = imported->surface->surface, path = folder / "modes" / "wall_thickness.vtp"] {
        write_wall_thickness(path, surface);
      });
    }
  }
  if (results.finite_elements && results.finite_elements->damped)
    files.emplace_back([&] { io::write_mat(folder / "models" / "part.mat", *results.finite_elements->damped); });
  const auto add_frf = [&](const std::string& name, const dynamics::ResponseModel& response) {
    files.emplace_back([&, name] { write_frf(folder / "frf", name, at_points(response, source.response.points)); });
  };
  if (results.part) add_frf("part", results.part->response);
  if (results.coupled) {
    add_frf("coupled_receptance", results.coupled->receptance.response);
    if (results.coupled->spatial_response) add_frf("coupled_spatial", *results.coupled->spatial_response);
  }
  const auto add_errors = [&](const std::string& name, const dynamics::ResponseModel& response,
                              const ResponseErrors& errors) {
    if (errors.noise.empty() && errors.truncation.empty()) return;
    files.emplace_back([&, name] {
      write_response_errors(folder / "frf" / (name + "_error.csv"), response, errors, source.response.points);
    });
  };
  if (results.part) add_errors("part", results.part->response, results.errors.part);
  if (results.robot) add_errors("robot", results.robot->response, results.errors.robot);
  if (results.coupled) add_errors("coupled", results.coupled->receptance.response, results.errors.coupled);
  if (results.robot) files.emplace_back([&] { write_frf(folder / "frf", "robot", results.robot->response); });
  if (results.survey) files.emplace_back([&] { write_survey(folder, source, *results.survey); });
  for (const auto& lobes : results.lobes) files.emplace_back([&] { write_lobes(folder / "lobes", lobes); });
  for (const auto& path : results.path) files.emplace_back([&] { write_path(folder / "lobes", source, path); });
  const std::size_t done = files.empty() ? 0 : 1;
  if (done > 0) files.front()();  // alone: VTK's first objects set up what all share
  core::parallel_for(files.size() - done, [&](std::size_t i) { files[done + i](); });
}

void publish(const fs::path& staging, const fs::path& folder) {
  const fs::path earlier = core::partial_path(folder / "earlier");
  try {
    fs::create_directory(earlier);
    for (const char* name : result_subfolders) {
      if (fs::exists(folder / name)) fs::rename(folder / name, earlier / name);
      fs::rename(staging / name, folder / name);
    }
    // The summary comes last but one: where it is, everything it speaks of is there.
    for (const char* name : {"case.toml", "case.resolved.toml", "case.fitted.toml", "summary.json", "manifest.json"}) {
      if (fs::exists(staging / name)) {
        fs::rename(staging / name, folder / name);
      } else {
        fs::remove(folder / name);
      }
    }
    fs::remove_all(staging);
    fs::remove_all(earlier);
  } catch (const fs::filesystem_error& error) {
    throw core::DataError(std::string("cannot replace the results of an earlier run: ") + error.what());
  }
}

void write_summary(const fs::path& folder, const Case& source, const Case& fitted, const nlohmann::json& summary,
                   const std::string& started_utc) {
  core::write_file_atomically(folder / "case.toml", source.source);
  core::write_file_atomically(folder / "case.resolved.toml", resolved_text(source));
  if (!source.updating.empty()) core::write_file_atomically(folder / "case.fitted.toml", resolved_text(fitted));
  core::write_file_atomically(folder / "summary.json", summary.dump(2) + "\n");
  nlohmann::json manifest;
  manifest["program"] = {{"name", "thinwall"}, {"version", program_version()}, {"built_with", doctor_report()}};
  manifest["threads"] = core::thread_count();
  manifest["started_utc"] = started_utc;
  manifest["timings_s"] = summary["timings_s"];
  manifest["inputs"] = nlohmann::json::array();
  for (const auto& input : input_files(source))
    manifest["inputs"].push_back({{"name", input.string()}, {"sha256", io::sha256_of_file(input)}});
  manifest["inputs"].push_back({{"name", source.file.string()}, {"sha256", io::sha256(source.source)}});
  const fs::path expected = source.file.parent_path() / "expected.toml";
  if (fs::exists(expected)) {
    manifest["inputs"].push_back({{"name", expected.string()}, {"sha256", io::sha256_of_file(expected)}});
  }
  manifest["seeds"] = nlohmann::json::array();
  const auto drawn = [](const nlohmann::json& chart) {
    return chart.contains("at_case_speed") && chart["at_case_speed"].contains("error_budget") &&
           chart["at_case_speed"]["error_budget"].contains("sampled");
  };
  if (std::ranges::any_of(summary["lobes"], drawn)) manifest["seeds"].push_back(source.lobes->seed);
  auto files = io::file_records(folder);
  std::erase_if(files, [](const auto& file) { return file.name == "manifest.json" || file.name == "run.log"; });
  manifest["outputs"] = records(files);
  core::write_file_atomically(folder / "manifest.json", manifest.dump(2) + "\n");
}

}  // namespace thinwall::app

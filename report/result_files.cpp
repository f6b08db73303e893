#include "report/result_files.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <functional>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "io/frf/mat_response.hpp"
#include "io/frf/response_csv.hpp"
#include "io/frf/uff.hpp"
#include "io/json_file.hpp"
#include "io/manifest.hpp"
#include "io/matrices/mat.hpp"
#include "io/results/csv_table.hpp"
#include "io/results/vtp.hpp"
#include "mesh/surface/wall_thickness.hpp"
#include "report/coherence_files.hpp"
#include "report/damping_files.hpp"
#include "report/error_summary.hpp"
#include "report/lobes/lobes_files.hpp"
#include "report/robot_report.hpp"
#include "report/shape_files.hpp"
#include "report/simulation/simulation_files.hpp"
#include "report/summary/summary_json.hpp"
#include "report/tool_files.hpp"
#include "setup/imported_part.hpp"
#include "study/lobes/tool_swap.hpp"
#include "study/support/robot_survey.hpp"

namespace thinwall::report {

namespace {

namespace fs = std::filesystem;

/// The part's own surface with the thickness of the wall beneath each triangle.
void write_wall_thickness(const fs::path& file, const mesh::TriangleSurface& surface) {
  io::write_vtp(file, surface, {{"wall_thickness_m", mesh::wall_thickness(surface, mesh::TriangleTree(surface))}});
}

void write_frf(const fs::path& folder, const std::string& name, const dynamics::ResponseModel& response) {
  io::write_response(folder / (name + ".csv"), response);
  io::write_mat_response(folder / (name + ".mat"), {response, {}, {}});
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

/// The finite-element model: shapes of its modes, its walls and its matrices.
void add_models(FileTasks& files, const fs::path& folder, const setup::Setup& source, const study::Results& results) {
  if (!results.finite_elements) return;
  write_shapes(files, folder / "modes", source, results);
  if (const auto& imported = source.part->imported; imported && imported->surface) {
    files.emplace_back([&surface = imported->surface->surface, path = folder / "modes" / "wall_thickness.vtp"] {
      write_wall_thickness(path, surface);
    });
  }
  if (results.finite_elements->damped)
    files.emplace_back(
        [&, folder] { io::write_mat(folder / "models" / "part.mat", *results.finite_elements->damped); });
}

/// The receptances of part, robot and both, on the axis of the case and on the lines that were added at resonances.
void add_responses(FileTasks& files, const fs::path& folder, const std::vector<std::string>& points,
                   const study::Results& results) {
  const auto add = [&](const std::string& name, const dynamics::ResponseModel& response) {
    files.emplace_back([&, folder, name] { write_frf(folder, name, at_points(response, points)); });
  };
  if (results.part) add("part", results.part->response);
  if (results.coupled) {
    add("coupled_receptance", results.coupled->receptance.response);
    if (results.coupled->spatial_response) add("coupled_spatial", *results.coupled->spatial_response);
  }
  if (results.robot) files.emplace_back([&, folder] { write_frf(folder, "robot", results.robot->response); });
  const auto add_lines = [&](const std::string& name, const std::optional<dynamics::ResponseModel>& lines) {
    if (!lines) return;
    files.emplace_back(
        [&, path = folder / (name + "_added.csv")] { io::write_response(path, at_points(*lines, points)); });
  };
  add_lines("part", results.added.part);
  add_lines("coupled_receptance", results.added.coupled);
  add_lines("coupled_spatial", results.added.coupled_spatial);
  if (const auto& lines = results.added.robot)
    files.emplace_back([&, folder] { io::write_response(folder / "robot_added.csv", *lines); });
}

/// The parts of the receptances' errors that are known by line.
void add_errors(FileTasks& files, const fs::path& folder, const std::vector<std::string>& points,
                const study::Results& results) {
  const auto add = [&](const std::string& name, const dynamics::ResponseModel& response,
                       const study::ResponseErrors& errors) {
    if (errors.noise.empty() && errors.truncation.empty()) return;
    files.emplace_back(
        [&, path = folder / (name + "_error.csv")] { write_response_errors(path, response, errors, points); });
  };
  if (results.part) add("part", results.part->response, results.errors.part);
  if (results.robot) add("robot", results.robot->response, results.errors.robot);
  if (results.coupled) add("coupled", results.coupled->receptance.response, results.errors.coupled);
}

/// Files of measurements: the coherence of FRFs, and the FRF that the damping was taken from beside the model's.
void add_measured(FileTasks& files, const fs::path& folder, const setup::Setup& source, const study::Results& results) {
  const auto add_coherence = [&](const std::string& name, const dynamics::ResponseModel& response,
                                 const std::vector<setup::MeasuredFrf>& measured) {
    files.emplace_back(
        [&, path = folder / (name + "_coherence.csv")] { write_coherence(path, measured, response.axis); });
  };
  const auto* damping = std::get_if<setup::ModalDamping>(&source.damping);
  if (damping != nullptr && damping->from_frf && results.part && results.part->modal) {
    files.emplace_back([&, damping, path = folder / "part_damping.csv"] {
      write_damping_frf(path, *damping->from_frf, *results.part->modal);
    });
  }
  if (results.part) add_coherence("part", results.part->response, source.measured_part);
  const auto* robot = source.robot ? std::get_if<setup::MeasuredRobot>(&source.robot->model) : nullptr;
  if (results.robot && robot != nullptr) add_coherence("robot", results.robot->response, robot->measured);
}

}  // namespace

void write_structure(const fs::path& folder, const setup::Setup& source, const study::Results& results) {
  constexpr std::array subfolders{"modes", "frf", "robot", "models"};
  for (const char* name : subfolders) fs::create_directories(folder / name);
  FileTasks files;
  add_models(files, folder, source, results);
  add_responses(files, folder / "frf", source.response.points, results);
  add_errors(files, folder / "frf", source.response.points, results);
  add_measured(files, folder / "frf", source, results);
  if (results.survey) files.emplace_back([&] { write_survey(folder, source, *results.survey); });
  const std::size_t done = files.empty() ? 0 : 1;
  if (done > 0) files.front()();  // alone: VTK's first objects set up what all share
  core::parallel_for(files.size() - done, [&](std::size_t i) { files[done + i](); });
  for (const char* name : subfolders) {
    if (fs::is_empty(folder / name)) fs::remove(folder / name);
  }
}

void write_cuts(const fs::path& folder, const setup::Setup& source, const study::Results& results) {
  write_simulation(folder, results);
  if (results.lobes.empty() && results.path.empty()) return;
  fs::create_directories(folder / "lobes");
  for (const auto& lobes : results.lobes) write_lobes(folder / "lobes", lobes);
  const fs::path tip = folder / "lobes" / "tool_frf.csv";
  if (source.tool && source.tool->swap)
    write_swapped_frf(tip, study::swapped_tip(results.setup).tip, results.synthesised_tip);
  else if (source.tool) write_tool_frf(tip, *source.tool, results.synthesised_tip);
  for (const auto& path : results.path) write_path(folder / "lobes", source, path);
}

void write_summary(const fs::path& folder, const Summary& summary, nlohmann::json manifest) {
  io::write_json(folder / "summary.json", summary_json(summary));
  auto files = io::file_records(folder);
  std::erase_if(files, [](const auto& file) { return file.name == "manifest.json" || file.name == "run.log"; });
  manifest["timings_s"] = summary.timings_s;
  manifest["outputs"] = records(files);
  io::write_json(folder / "manifest.json", manifest);
}

}  // namespace thinwall::report

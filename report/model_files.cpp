#include "report/model_files.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "dynamics/sparse_spatial.hpp"
#include "io/matrices/dof_table_csv.hpp"
#include "io/matrices/mat.hpp"
#include "io/matrices/mat_sparse.hpp"
#include "io/matrices/matrix_files.hpp"
#include "io/matrices/matrix_market.hpp"

namespace thinwall::report {

namespace {

namespace fs = std::filesystem;

void write_matrices(const fs::path& folder, const PlacedModel& placed_model) {
  dynamics::SparseModel sparse = dynamics::sparse_model(placed_model.model);
  for (const auto& dof : sparse.dofs) {
    const auto found = placed_model.positions.find(dynamics::point_name(sparse, dof));
    if (dof.component > 0 && found != placed_model.positions.end()) sparse.positions[dof.node] = found->second;
  }
  io::write_matrix_market(folder / "stiffness.mtx", sparse.K);
  io::write_matrix_market(folder / "mass.mtx", sparse.M);
  if (sparse.has_damping()) io::write_matrix_market(folder / "damping.mtx", sparse.C);
  io::write_dof_table(folder / "dofs.csv", sparse);
}

/// A model with a DOF table of names, or matrices numbered by nodes.
PlacedModel read_mat_file(const fs::path& path) {
  try {
    return {io::read_mat(path), {}};
  } catch (const core::DataError&) {
    return placed(io::read_sparse_mat(path));
  }
}

[[noreturn]] void refuse_model_folder(const fs::path& folder, const std::string& cause) {
  throw core::DataError("cannot write the model to \"" + folder.string() + "\": " + cause +
                        "; choose another folder with -o");
}

}  // namespace

PlacedModel placed(const dynamics::SparseModel& sparse) {
  PlacedModel result{dynamics::spatial_model(sparse), {}};
  for (const auto& dof : sparse.dofs) {
    const auto found = sparse.positions.find(dof.node);
    if (dof.component > 0 && found != sparse.positions.end())
      result.positions[dynamics::point_name(sparse, dof)] = found->second;
  }
  return result;
}

void make_model_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    refuse_model_folder(folder, "it is a file, not a folder");
  fs::create_directories(folder, error);
  if (error) refuse_model_folder(folder, error.message());
  try {
    const core::PartialFile never_committed(folder / "trial");
    core::write_file_atomically(never_committed.partial(), std::string(16384, '\n'));  // a full disk shows
  } catch (const core::DataError& unwritable) {
    refuse_model_folder(folder, unwritable.what());
  }
}

std::string write_model(const fs::path& folder, const PlacedModel& model) {
  make_model_folder(folder);
  io::write_mat(folder / "model.mat", model.model);
  std::error_code ignored;  // of an earlier model; what remains is written over
  for (const char* name : {"stiffness.mtx", "mass.mtx", "damping.mtx", "dofs.csv"}) fs::remove(folder / name, ignored);
  try {
    write_matrices(folder, model);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

PlacedModel read_model(const fs::path& path) {
  if (!fs::is_directory(path)) return read_mat_file(path);
  if (fs::exists(path / "stiffness.mtx")) {
    const auto optional = [&](const char* name) { return fs::exists(path / name) ? path / name : fs::path(); };
    return placed(io::read_matrices({.stiffness = path / "stiffness.mtx",
                                     .mass = path / "mass.mtx",
                                     .damping = optional("damping.mtx"),
                                     .dofs = path / "dofs.csv",
                                     .length_unit = "m",
                                     .mass_unit = "kg"})
                      .model);
  }
  if (fs::exists(path / "model.mat")) return read_mat_file(path / "model.mat");
  throw core::DataError(path.string() +
                        ": neither stiffness.mtx nor model.mat is there; \"thinwall reduce\" writes both");
}

}  // namespace thinwall::report

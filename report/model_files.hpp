#pragma once
// A reduced model as a folder that `thinwall inspect`, a case and other programs read.

#include <filesystem>
#include <string>

#include "dynamics/sparse_model.hpp"
#include "dynamics/spatial_model.hpp"
#include "reduction/trust/rigid_sets.hpp"

namespace thinwall::report {

/// A model with the places of its points (m, the part's axes), as far as they are known.
struct PlacedModel {
  dynamics::SpatialModel model;
  reduction::Positions positions;
};

/// Imported matrices as a dense model with named DOFs. Throws InputError as dynamics::spatial_model().
[[nodiscard]] PlacedModel placed(const dynamics::SparseModel& sparse);

/// Makes the folder of a model if need be and tries to write there. Throws DataError, with the cause and "-o" as the
/// remedy.
void make_model_folder(const std::filesystem::path& folder);

/// Writes model.mat (io/matrices/mat.hpp), and, where every row is a node's component along an axis, stiffness.mtx,
/// mass.mtx, damping.mtx where there is damping, and dofs.csv, in SI: numbers that read back as they were. The folder
/// is made if need be. Returns what could not be written and why, "" if nothing. Throws DataError if a file cannot be
/// written.
std::string write_model(const std::filesystem::path& folder, const PlacedModel& model);

/// The model that write_model() left in a folder, or a MAT file of io/matrices/mat.hpp or io/matrices/mat_sparse.hpp in
/// SI. Throws DataError that says what is missing.
[[nodiscard]] PlacedModel read_model(const std::filesystem::path& path);

}  // namespace thinwall::report

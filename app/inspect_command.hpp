#pragma once
// `thinwall inspect`: may this model be trusted, and what does this universal file hold?

#include <filesystem>
#include <optional>
#include <string>

#include "io/matrices/matrix_files.hpp"

namespace thinwall::app {

/// The request of `thinwall inspect`.
struct InspectRequest {
  std::filesystem::path model;       ///< a folder of `thinwall reduce`, a MAT file, a universal file; or, empty:
  io::MatrixFiles files;             ///< matrices of any program
  std::optional<int> rigid_motions;  ///< how many must be free; left out: told, not judged
  std::optional<std::filesystem::path> json;  ///< where the report goes as JSON
};

/// The text of reduction::report(), and whether nothing was found against the model; of a universal file its table, and
/// whether all of it could be read (app/inspect_universal.hpp).
struct Inspection {
  std::string text;
  bool trustworthy = false;
};

/// Throws UsageError for options that are missing, DataError for files that cannot be read, InputError for what no
/// model is.
[[nodiscard]] Inspection inspect(const InspectRequest& request);

}  // namespace thinwall::app

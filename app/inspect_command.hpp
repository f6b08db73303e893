#pragma once
// `thinwall inspect`: may this model be trusted?

#include <filesystem>
#include <optional>
#include <string>

#include "io/matrices/matrix_files.hpp"

namespace thinwall::app {

/// The request of `thinwall inspect`.
struct InspectRequest {
  std::filesystem::path model;                ///< a folder of `thinwall reduce`, or a MAT file; or, empty:
  io::MatrixFiles files;                      ///< matrices of any program
  std::optional<int> rigid_motions;           ///< how many must be free; left out: told, not judged
  std::optional<std::filesystem::path> json;  ///< where the report goes as JSON
};

/// The text of reduction::report(), and whether nothing was found against the model.
struct Inspection {
  std::string text;
  bool trustworthy = false;
};

/// Throws UsageError for options that are missing, DataError for files that cannot be read, InputError for what no
/// model is.
[[nodiscard]] Inspection inspect(const InspectRequest& request);

}  // namespace thinwall::app

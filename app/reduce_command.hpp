#pragma once
// `thinwall reduce`: the part of a case as a small model, with what it is off by and whether it can be trusted.

#include <filesystem>
#include <optional>
#include <string>

#include "app/stage_display.hpp"
#include "case/machining_case.hpp"

namespace thinwall::app {

/// The request of `thinwall reduce` beside the case.
struct ReduceRequest {
  std::filesystem::path out = "model";   ///< folder
  std::string method = "craig_bampton";  ///< a name of reduction::Method
  std::optional<int> modes;              ///< elastic modes kept
  std::optional<double> tolerance;       ///< on the interface's receptance over the band; craig_bampton only
  std::optional<double> from_hz, to_hz;  ///< the band; the case's response if not given
  std::optional<int> characteristic;     ///< amplitudes of a reduced interface
  bool compare = false;                  ///< all methods side by side, at the size of this one
  ProgressDisplay display = ProgressDisplay::lines;
};

/// Throws UsageError for options that cannot be, whatever the case.
void require_options(const ReduceRequest& request);

/// Meshes and reduces the part to its points, measures the error of the interface's receptance over the band against
/// the full model, writes the model (report/model_files.hpp), report.json and report.txt into the folder, and returns
/// the text for the terminal. With neither modes nor tolerance: what the case's [reduction] says, or else a tolerance
/// of 1 %. Throws before anything is computed: as require_options(), InputError for a case without part or points,
/// DataError for a folder that cannot be made or written to. Later InputError for what the method refuses;
/// NumericalError where the mode count does not meet the tolerance.
[[nodiscard]] std::string reduce_part(const cases::Case& source, const ReduceRequest& request);

}  // namespace thinwall::app

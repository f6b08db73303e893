#pragma once
// The result of `thinwall fit`: a text for the terminal and a folder of files.

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "identification/fit_response.hpp"

namespace thinwall::report {

/// A fit with what was measured and what is to be said of it.
struct FitReport {
  dynamics::ResponseModel measured;
  identification::ResponseFit fit;
  std::vector<std::string> doubts;  ///< warnings
  std::vector<std::string> notes;
};

/// The files that write_fit() writes.
inline constexpr std::array fit_file_names{"modes.csv", "modal_table.csv", "modes.uff", "fit.json", "fitted.csv"};

/// Frequencies and dampings with their 95 % intervals, masses and stiffnesses at the driving points, χ² and misfit,
/// warnings and notes.
[[nodiscard]] std::string fit_text(const FitReport& found);

/// Writes into a folder, which is made if need be:
///
///   modes.csv        frequency, damping, 95 % intervals; of a single point stiffness and direction, for `lobes`
///   modal_table.csv  frequency, damping, left and right vectors in √(s/kg), for `[robot] model = "modal_table"`
///   modes.uff        shapes, data set 55
///   fit.json         all figures: modes, residues, χ², terms, misfit by entry, MAC
///   fitted.csv       the model on the lines that were used, as io::write_response() has it
///
/// Returns what could not be written and why, and what share of the fit the modes of modes.csv alone leave out: terms
/// beside the modes, second shapes of a double pole. Throws DataError for a folder that cannot be made or written.
std::vector<std::string> write_fit(const std::filesystem::path& folder, const FitReport& found);

}  // namespace thinwall::report

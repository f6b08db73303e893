#pragma once
// The result of `thinwall fit` as a folder of files.

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "report/fit/fit_report.hpp"

namespace thinwall::report {

/// The files that write_fit() writes. fit.json is the last that appears.
inline constexpr std::array fit_file_names{"modes.csv",  "modal_table.csv", "modes.uff",
                                           "fitted.csv", "fit.html",        "fit.json"};

/// Writes into a folder, which is made if need be:
///
///   modes.csv        frequency, damping, 95 % intervals; of a single point stiffness and direction, for `lobes`
///   modal_table.csv  frequency, damping, left and right vectors in √(s/kg), for `[robot] model = "modal_table"`
///   modes.uff        shapes, data set 55
///   fit.json         all figures: modes, residues, χ², terms, misfit by entry, MAC
///   fitted.csv       the model on the lines that were used, as io::write_response() has it
///   fit.html         the page, made by `program` ("thinwall 0.1.0")
///
/// They appear together, in the place of those of an earlier fit; other files of the folder stay. Returns what could
/// not be written and why, and what share of the fit the modes of modes.csv alone leave out: terms beside the modes,
/// second shapes of a double pole. Throws DataError for a folder that cannot be made or written.
std::vector<std::string> write_fit(const std::filesystem::path& folder, const FitReport& found,
                                   const std::string& program);

}  // namespace thinwall::report

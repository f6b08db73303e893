#pragma once
// The figures of a fit as a document.

#include <nlohmann/json.hpp>

#include "report/fit/fit_report.hpp"

namespace thinwall::report {

/// Modes with intervals and residues, χ², terms, lines, misfit by entry, MAC of the residues, warnings, DOFs. What is
/// not a number, as an interval of poles that the lines do not tell apart, is null.
[[nodiscard]] nlohmann::json fit_json(const FitReport& found);

/// |aᴴb|²/(aᴴa bᴴb) of the residues as vectors, modes × modes.
[[nodiscard]] Eigen::MatrixXd mac_of_residues(const std::vector<identification::FittedMode>& modes);

}  // namespace thinwall::report

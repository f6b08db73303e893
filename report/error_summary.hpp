#pragma once
// The error budget in summary.json and as tables beside the curves that it belongs to.

#include <filesystem>
#include <string>
#include <vector>

#include "report/summary/errors.hpp"
#include "study/results.hpp"

namespace thinwall::report {

/// `error_budget` of summary.json: of part, robot and coupled response the largest truncation and noise relative to the
/// largest entry of the line, and where. What is not known to be wrong is absent.
[[nodiscard]] ErrorBudgetSummary error_budget_summary(const study::Results& results);

/// `error_budget` of a chart: the largest of all rows, relative to their depths, and that of the row of least depth.
/// None where nothing is known to be wrong.
[[nodiscard]] std::optional<ChartErrorsSummary> chart_errors_summary(const study::StructureLobes& named);

/// The error summary of the row at the case's own speed, with what drawing samples gave.
[[nodiscard]] DepthErrorsSummary row_errors_summary(const study::DepthError& error,
                                                    const std::optional<milling::DepthScatter>& scatter, int seed);

/// frequency_hz, then of every entry between the points (all if none of them is there) the standard deviation by noise
/// and the modulus of the truncation, as far as they are known. Throws DataError if the file cannot be written.
void write_response_errors(const std::filesystem::path& file, const dynamics::ResponseModel& response,
                           const study::ResponseErrors& errors, const std::vector<std::string>& points);

}  // namespace thinwall::report

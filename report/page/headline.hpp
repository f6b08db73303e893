#pragma once
// The answers of a run in sentences; the main answer first.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace thinwall::report {

/// The first line, from summary.json: "With the robot at P: stable up to 20 mm at 1900 rpm (tool length); without:
/// 1.7 mm.", then "Best pocket …; margin …; estimated error … ." as far as they are known. Of a run with a path the
/// limits are those of the whole path. Of a run without lobes what falls at the resonances, or the first modes. A
/// limit that did not converge is not called stable. Plain text, not escaped.
[[nodiscard]] std::vector<std::string> headline(const nlohmann::json& summary);

/// Sentences below the main answer: operating points, the chart at the cut point of a run with a path, how both routes
/// agree, and what the run itself said of its charts (`sentences` of summary.json).
[[nodiscard]] std::vector<std::string> sentences(const nlohmann::json& summary);

/// The relative error of a limit at a row of summary.json (at_case_speed, or a chart with its least depth) may be off,
/// relative: the estimate of the computation, what the part's reduction left out, and twice the standard deviation by
/// the noise of measured FRFs, as the chart's band has them. Where the row does not tell, the chart's largest. 0:
/// nothing is known.
[[nodiscard]] double depth_error(const nlohmann::json& row, const nlohmann::json& chart);

}  // namespace thinwall::report

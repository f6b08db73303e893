#pragma once
// Two runs for a reader: the answer of each, and the figures that matter most among those that differ.

#include <filesystem>
#include <string>

#include "report/compare.hpp"

namespace thinwall::report {

/// The headline of each of two result folders below its name. A summary from which none can be made, as of another
/// version, is told as such. Throws DataError as compare_results() does.
[[nodiscard]] std::string answers_text(const std::filesystem::path& left, const std::filesystem::path& right);

/// A table of at most ten figures of the summary that differ, those first on which the answer hangs most: limiting
/// depths, pockets, operating points, chatter frequencies, then modes. Each has both values, the change relative to the
/// left one, and its meaning. Empty if none of these differs.
[[nodiscard]] std::string main_figures_text(const Comparison& comparison);

/// "12 in summary.json, 3400 in lobes/part.csv": the number of differences in each file, in the order of the files.
[[nodiscard]] std::string differences_by_file(const Comparison& comparison);

}  // namespace thinwall::report

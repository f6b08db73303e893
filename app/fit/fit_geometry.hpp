#pragma once
// Places of the points of a test, for the page of `thinwall fit`.

#include <string>
#include <vector>

#include "report/fit/fit_report.hpp"

namespace thinwall::app {

/// The points and lines of a file: a universal file (nodes as "node 12", trace lines), or a CSV with the columns point,
/// x_m, y_m, z_m. Without `file` those of the first universal file among `measured` whose nodes can be read, else none;
/// `notes` tells of nodes that cannot. Throws DataError for a file that is named and cannot be read.
[[nodiscard]] report::TestGeometry test_geometry(const std::string& file, const std::vector<std::string>& measured,
                                                 std::vector<std::string>& notes);

}  // namespace thinwall::app

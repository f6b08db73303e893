#pragma once
// A chart with as many speeds as its line needs to follow the boundary between them.

#include <string>
#include <vector>

#include "milling/chart/line_error.hpp"
#include "milling/chart/lobes.hpp"
#include "milling/chart/operating_point.hpp"
#include "milling/cut/process.hpp"

namespace thinwall::milling {

/// The line that is wanted.
struct LineOptions {
  double tolerance = 0.02;     ///< relative, in (0, 1): of the line between two speeds, against the boundary there
  int most_added = 400;        ///< ≥ 0: speeds added at which refinement gives up
  double narrow = narrow_gap;  ///< relative width of gaps that are not halved
};

/// Every violation, empty if there is none.
[[nodiscard]] std::vector<std::string> validate(const LineOptions& options);

/// The chart with speeds added until every gap of line_gaps() meets the tolerance (or what the error of the two rows
/// leaves to be gained), then with the `asked` speeds within its range, which do not count as added: points that are
/// looked at lie on the line. A generation adds speeds to all gaps that miss the tolerance, one where two lobes meet
/// and up to three where the boundary bends, widest and worst first where most_added is less, and one to a gap as wide
/// as those of the even speeds of which the rows of one side alone tell; its rows share out among
/// core::thread_count() threads, each with the depth of the line as the one expected, and follow crossings to
/// three times the first one (those of asked speeds as far as options.follow says). Before a speed that is
/// added, the rows do not depend on `asked`, and never on the number of threads nor on what was kept: here a block is
/// one row, by the number of rows before its generation and its place therein. Lobes::line tells what was reached.
/// A narrow lobe that lies between two speeds as a whole is seen if it is a flip or fold lobe on the flank of the Hopf
/// lobe that is the boundary (line_gaps), others are not. Throws InputError for bad options or a chart of fewer than
/// two speeds; what row_at throws; Interrupted. Cost: a row for each added speed.
[[nodiscard]] Lobes refined(Lobes chart, const RowAt& row_at, const MillingProcess& process,
                            const StabilityOptions& options, const LineOptions& line,
                            const std::vector<double>& asked = {}, const KeptRows& kept = {});

}  // namespace thinwall::milling

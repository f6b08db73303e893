#pragma once
// A stability chart: the limiting depth over a range of speeds.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "milling/chart/lobe_method.hpp"
#include "milling/direct/stability.hpp"

namespace thinwall::milling {

/// The line of a chart, straight between neighbouring speeds, against the boundary that it stands for.
struct DrawnLine {
  double tolerance = 0.0;             ///< that was wanted, relative
  double error_estimate = 0.0;        ///< largest distance from the boundary, relative; infinite: not known
  double at_spindle_speed_rpm = 0.0;  ///< amid the two speeds between which that is
  int speeds_added = 0;               ///< for the line's sake
  bool met = false;                   ///< the tolerance, or what errors of the rows themselves leave to be gained
};

/// A chart by one method.
struct Lobes {
  std::string method;
  std::vector<LobeRow> rows;          ///< in the order of the speeds
  double minimum_depth_m = 0.0;       ///< least limiting depth, the absolute stability limit of the range
  double at_spindle_speed_rpm = 0.0;  ///< where that is
  double worst_error_estimate = 0.0;  ///< largest of the rows that are not sound at the limit
  double residual_share = 0.0;        ///< static compliance that the analysis leaves out, see RelativeStructure
  int rows_at_limit = 0;              ///< stable up to the depth limit
  int rows_not_converged = 0;         ///< step limit reached, or eigenvalue not converged
  std::optional<DrawnLine> line;      ///< none of a chart whose speeds were not refined
};

/// `count` speeds, evenly spaced from `from_rpm` to `to_rpm`. Throws InputError unless 0 < from < to and count ≥ 2.
[[nodiscard]] std::vector<double> spindle_speeds(double from_rpm, double to_rpm, int count);

/// The chart of rows in the order of their speeds. Throws InputError if there are none.
[[nodiscard]] Lobes lobes_of(std::vector<LobeRow> rows, std::string method);

/// Rows that a chart need not compute, by blocks of eight neighbouring speeds, and where it puts those that it did.
struct KeptRows {
  std::function<std::vector<LobeRow>(std::size_t first)> find{};  ///< of the block that begins there; empty: compute it
  std::function<void(std::size_t first, const std::vector<LobeRow>&)> add{};  ///< one call at a time
};

/// Rows at every speed by `at`, which is told the limit of the speed before in its block, the blocks shared out among
/// core::thread_count() threads; the rows do not depend on the number of threads, nor on what was kept. Interruptible.
[[nodiscard]] std::vector<LobeRow> rows_by_blocks(
    const std::vector<double>& spindle_speeds_rpm,
    const std::function<LobeRow(double rpm, std::optional<double> expected_m)>& at, const KeptRows& kept);

/// The row `at(i)` of every speed by its number, each a block by itself, which is kept under `first` + i; kept rows of
/// another speed are not taken. Otherwise as rows_by_blocks().
[[nodiscard]] std::vector<LobeRow> separate_rows(const std::vector<double>& spindle_speeds_rpm,
                                                 const std::function<LobeRow(std::size_t i)>& at, std::size_t first,
                                                 const KeptRows& kept);

/// The method's limiting_depth() at every speed, the speeds shared out among core::thread_count() threads; the rows do
/// not depend on the number of threads. Throws InputError for a bad speed or if there are no speeds; Interrupted.
[[nodiscard]] Lobes stability_lobes(const LobeMethod& method, const std::vector<double>& spindle_speeds_rpm,
                                    const KeptRows& kept = {});

/// Lobes by the direct method; otherwise as the function above. Throws InputError for a bad process or option too.
[[nodiscard]] Lobes stability_lobes(const RelativeStructure& structure, const MillingProcess& process,
                                    const std::vector<double>& spindle_speeds_rpm, const StabilityOptions& options);

}  // namespace thinwall::milling

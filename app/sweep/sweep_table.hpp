#pragma once
// Results of a sweep, a row for each point.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/sweep/sweep_grid.hpp"
#include "report/summary/summary.hpp"

namespace thinwall::app {

/// The main figures of a summary by the name of their column: the first three modes of the part and of part with robot
/// (`part_mode_1_hz`, `supported_mode_1_hz`), the largest fall of the vibration at the contact
/// (`vibration_falls_percent`), and of each chart the stable depth at the case's speed (`part_depth_at_speed_mm`, and
/// `part_depth_at_limit`: 1 where the chart ends there), the least depth and its speed. What the run did not compute is
/// left out.
using SweepFigures = std::vector<std::pair<std::string, double>>;
[[nodiscard]] SweepFigures sweep_figures(const report::Summary& summary);

/// One point of a sweep: what it was and what became of it.
struct SweepRow {
  std::size_t number = 0;  ///< from 1
  app::GridPoint point;
  std::string status = "not_computed";  ///< else that of summary.json: "ok" …, or "failed"
  int exit_code = 0;                    ///< that `run` would have ended with
  std::string reason;                   ///< of a failure, in one line
  SweepFigures figures;
};

struct SweepTable {
  std::vector<SweepAxis> axes;
  std::vector<SweepRow> rows;

  /// Columns of the figures that any row has, in the order of sweep_figures().
  [[nodiscard]] std::vector<std::string> columns() const;
};

/// The table as CSV: point, one column an axis ("part.thickness [mm]"), the figures, status and reason.
[[nodiscard]] std::string sweep_csv(const SweepTable& table);

/// The table for a terminal: aligned, four digits, without the higher modes.
[[nodiscard]] std::string sweep_text(const SweepTable& table);

/// Stable depths (or least depths, without a speed) and the first modes over the first axis that has numbers, as a
/// drawing in SVG: a line a chart and combination of the other axes, the first eight. "" where there is nothing to
/// draw.
[[nodiscard]] std::string sweep_svg(const SweepTable& table);

}  // namespace thinwall::app

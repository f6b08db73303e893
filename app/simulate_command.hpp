#pragma once
// `thinwall simulate`: operating points of a case in the time domain.

#include <filesystem>
#include <string>
#include <vector>

#include "app/stage_display.hpp"
#include "case/machining_case.hpp"
#include "milling/chart/operating_point.hpp"

namespace thinwall::app {

/// The options of `thinwall simulate`, besides those of every case.
struct SimulateRequest {
  std::string paths = "circular";
  ProgressDisplay display = ProgressDisplay::none;  ///< how stages are shown
  int settling_turns = 400, turns = 200, traced_turns = 50, steps = 200;
};

/// Computes part, robot and both as `run` does, with the part that an earlier run in the same folder has kept,
/// simulates the points, writes simulation/ into `out` (empty: results/<case>) and returns the text for the terminal.
/// Throws core::Error.
[[nodiscard]] std::string simulate_case(cases::Case source, const std::vector<milling::OperatingPoint>& points,
                                        const std::filesystem::path& out, const SimulateRequest& request);

}  // namespace thinwall::app

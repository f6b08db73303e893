#pragma once
// `thinwall simulate`: operating points of a case in the time domain.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/stage_display.hpp"
#include "case/machining_case.hpp"

namespace thinwall::app {

/// The options of `thinwall simulate`, besides those of every case: what is given takes the place of [simulation].
struct SimulateRequest {
  std::vector<std::string> points;  ///< "5000 rpm, 0.5 mm"
  std::optional<std::string> paths;
  std::optional<int> settling_turns, turns, traced_turns, steps;
};

/// The case of that path with the options of the request put over its [simulation]; one without [simulation] gets it
/// with its defaults. Throws as cases::read_case(), and UsageError for points that are none.
[[nodiscard]] cases::Case simulated_case(const std::filesystem::path& path, std::vector<std::string> overrides,
                                         const SimulateRequest& request);

/// Computes part, robot and both as `run` does, with the part that an earlier run in the same
/// folder has kept, simulates what the case's [simulation] says, writes simulated/ into `out` (empty: results/<case>),
/// beside the simulation/ of `run` that summary.json belongs to, and returns the text for the terminal. Throws
/// core::Error.
[[nodiscard]] std::string simulate_case(cases::Case source, const std::filesystem::path& out, ProgressDisplay display);

}  // namespace thinwall::app

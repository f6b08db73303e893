#pragma once
// From a case to a folder of results.

#include <filesystem>
#include <functional>
#include <vector>

#include "case/machining_case.hpp"
#include "milling/chart/operating_point.hpp"
#include "report/result_folder.hpp"
#include "report/summary/summary.hpp"

namespace thinwall::app {

struct RunOptions {
  std::filesystem::path out;                         ///< the result folder, already prepared (report/result_folder.hpp)
  bool fresh = false;                                ///< ignore results of an earlier run
  int verbosity = 0;                                 ///< −1 quiet, 0 normal, 1 verbose
  bool progress = false;                             ///< stage, count and time left in one line of the terminal
  std::vector<milling::OperatingPoint> points = {};  ///< of which the charts are asked
  bool stage_lines = true;                           ///< without `progress`: the same as lines of the log
  std::filesystem::path parts = {};  ///< where parts are kept for several runs, by key; empty: in `out`, the last one
  report::ResultFolder* held = nullptr;  ///< `out` as this process holds it; null: nobody else writes there
};

struct RunResult {
  report::Summary summary;
  bool expectations_hold = true;  ///< false: exit 6
};

/// The function to which `run`, `lobes` and `sweep` hand a case; in the program this is run_case().
using RunCase = std::function<RunResult(const cases::Case&, const RunOptions&)>;

/// Does what the case holds and writes the result folder. Throws core::Error.
[[nodiscard]] RunResult run_case(const cases::Case& source, const RunOptions& options);

}  // namespace thinwall::app

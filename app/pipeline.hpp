#pragma once
// From a case to its results.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/case.hpp"
#include "milling/operating_point.hpp"

namespace thinwall::app {

struct RunOptions {
  std::filesystem::path out;                         ///< the result folder, already prepared (app/result_folder.hpp)
  bool fresh = false;                                ///< ignore results of an earlier run
  int verbosity = 0;                                 ///< −1 quiet, 0 normal, 1 verbose
  bool progress = false;                             ///< stage, count and time left on stderr
  std::vector<milling::OperatingPoint> points = {};  ///< of which the charts are asked
};

struct RunResult {
  nlohmann::json summary;         ///< summary.json (design.md section 7)
  bool expectations_hold = true;  ///< false: exit 6
};

/// Does what the case holds and writes the result folder. Throws core::Error.
[[nodiscard]] RunResult run_case(const Case& source, const RunOptions& options);

}  // namespace thinwall::app

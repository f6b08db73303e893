#pragma once
// One case at every point of a grid of its keys.

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "app/case_run.hpp"
#include "core/error.hpp"

namespace thinwall::app {

struct SweepRequest {
  std::string case_path;
  std::vector<std::string> keys;       ///< "part.thickness=4 mm:8 mm:0.5 mm" (app/sweep/sweep_grid.hpp)
  std::vector<std::string> overrides;  ///< of every point
  std::string out;                     ///< empty: results/<case>-sweep
  std::string shard;                   ///< "2/4": a quarter of the points; empty: all
  bool fresh = false;                  ///< compute points that are there, too
  int verbosity = 0;                   ///< as of RunOptions
  std::string progress = "auto";       ///< of the stages of a point: auto (on a terminal), always, never
  bool slurm = false;                  ///< write the scripts of a job array in place of computing
  bool submit = false;                 ///< hand them to sbatch, too
  bool parallel = false;               ///< write a script of GNU parallel in place of computing
  std::size_t shards = 0;              ///< of the jobs; 0: one a point, 100 at most
  std::vector<std::string> sbatch{};   ///< further options of sbatch: "--partition=long"
  int threads = 0;                     ///< of a job; 0: one
};

/// Runs the case at each point of the grid into OUT/001, OUT/002 … and writes OUT/sweep.csv and OUT/sweep.svg; prints
/// the table. A point that fails is a row with its reason, and the others go on. A point that is there from before is
/// kept if the program, its case with all defaults, its input files and its expectations are the same; of the points of
/// other shards what is there of this sweep is shown. An interruption leaves a table of what is done. Returns the exit
/// code of the first point that failed, else `expectation` where a point's expectations do not hold, else done. With
/// `slurm` or `parallel` the scripts are written (sweep_jobs.hpp) and nothing is computed. Throws
/// UsageError for keys and values that make no grid or overrides that are none, DataError where OUT cannot be written,
/// Interrupted.
[[nodiscard]] core::ExitCode run_sweep(const SweepRequest& request, const RunCase& run_case, std::ostream& out);

/// Collects the points of one sweep from the folders of its shards (which may be one folder) into the table and drawing
/// of `out`, and writes nowhere else; prints the table. A point that is in several is taken from the
/// first. Returns as run_sweep(); numerical, if points are missing. Throws UsageError for folders of different sweeps,
/// that is of other keys, values, cases, data, overrides or programs, DataError for a folder without a sweep or with
/// damaged files.
[[nodiscard]] core::ExitCode merge_sweeps(const std::vector<std::string>& folders, const std::filesystem::path& out,
                                          std::ostream& text);

}  // namespace thinwall::app

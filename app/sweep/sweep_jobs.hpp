#pragma once
// A sweep that other processes compute: its scripts for a cluster or for GNU parallel.

#include <ostream>

#include "app/sweep/job_scripts.hpp"
#include "app/sweep/sweep.hpp"
#include "app/sweep/sweep_table.hpp"

namespace thinwall::app {

/// The jobs of a sweep of so many points, none of which is computed. `sweep` is the request; the time of a shard is the
/// forecast of the grid's first point for each of its points. Throws UsageError for more shards than points, and as
/// forecast(). Cost: as forecast().
[[nodiscard]] SweepJobs sweep_jobs(const SweepRequest& sweep, const SweepTable& table,
                                   const std::filesystem::path& folder, const std::string& name);

/// Writes the scripts that the request asks for to the folder of the sweep, hands them to Slurm if it says so, and
/// prints what to do next. Throws DataError where a file cannot be written or sbatch fails.
void write_jobs(const SweepRequest& sweep, const SweepJobs& jobs, std::ostream& out);

}  // namespace thinwall::app

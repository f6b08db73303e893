#include "app/sweep/sweep_jobs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "app/forecast.hpp"
#include "case/reader.hpp"
#include "core/atomic_file.hpp"
#include "core/memory.hpp"

namespace thinwall::app {

namespace {

namespace fs = std::filesystem;

/// Shards of a sweep for which no number is given: one a point, as many as a cluster takes in one array.
constexpr std::size_t most_shards = 100;

std::vector<std::string> arguments_of(const SweepRequest& sweep, const fs::path& folder, int threads) {
  std::vector<std::string> arguments{"sweep", fs::absolute(sweep.case_path).lexically_normal().string()};
  std::ranges::copy(sweep.keys, std::back_inserter(arguments));
  for (const std::string& value : sweep.overrides) {
    arguments.emplace_back("--set");
    arguments.push_back(value);
  }
  std::ranges::copy(std::vector<std::string>{"--out", folder.string(), "--threads", std::to_string(threads), "-q"},
                    std::back_inserter(arguments));
  if (const double bytes = core::memory_limit_bytes(); bytes > 0.0) {
    arguments.emplace_back("--memory");
    arguments.push_back(fmt::format("{:.0f} MB", 1e-6 * bytes));
  }
  return arguments;
}

double seconds_of_first_point(const SweepRequest& sweep, const SweepTable& table) {
  std::vector<std::string> overrides = sweep.overrides;
  std::ranges::copy(overrides_at(table.axes, table.rows.front().point), std::back_inserter(overrides));
  return forecast(cases::read_case(sweep.case_path, overrides)).whole_s();
}

}  // namespace

SweepJobs sweep_jobs(const SweepRequest& sweep, const SweepTable& table, const fs::path& folder,
                     const std::string& name) {
  const std::size_t points = table.rows.size();
  if (sweep.shards > points)
    throw core::UsageError("--shards " + std::to_string(sweep.shards) + ": the sweep has " + std::to_string(points) +
                           " points; give a number up to that");
  SweepJobs jobs;
  jobs.name = name;
  jobs.program = fs::read_symlink("/proc/self/exe").string();
  jobs.folder = fs::absolute(folder).lexically_normal();
  jobs.from = fs::current_path();
  jobs.shards = sweep.shards > 0 ? sweep.shards : std::min(points, most_shards);
  jobs.threads = std::max(1, sweep.threads);
  jobs.sweep = arguments_of(sweep, jobs.folder, jobs.threads);
  const double points_of_shard = std::ceil(static_cast<double>(points) / static_cast<double>(jobs.shards));
  jobs.seconds = points_of_shard * seconds_of_first_point(sweep, table);
  jobs.memory_bytes = 1.1 * core::memory_limit_bytes();  // the program ends itself before the cluster does
  jobs.options = sweep.sbatch;
  return jobs;
}

void write_jobs(const SweepRequest& sweep, const SweepJobs& jobs, std::ostream& out) {
  // Logs and starts of an earlier sweep would be taken for those of this one.
  fs::remove_all(jobs.folder / "shards");
  fs::create_directories(jobs.folder / "shards");
  out << jobs.shards << " shards, each " << about(jobs.seconds) << '\n';
  if (sweep.parallel) {
    const fs::path script = jobs.folder / "parallel.sh";
    core::write_file_atomically(script, parallel_script(jobs));
    out << "wrote " << script.string() << "; run it with: bash " << shell_word(script.string()) << '\n';
  }
  if (!sweep.slurm) return;
  const SlurmScripts scripts = write_slurm_scripts(jobs);
  out << "wrote " << scripts.array.string() << " and " << scripts.merge.string() << '\n';
  if (sweep.submit) {
    out << "submitted as job " << submit(scripts) << "; the table will be in " << (jobs.folder / "merged").string()
        << '\n';
  } else {
    out << "submit them with: job=$(sbatch --parsable " << shell_word(scripts.array.string())
        << "); sbatch --dependency=afterany:$job " << shell_word(scripts.merge.string()) << '\n';
  }
}

}  // namespace thinwall::app

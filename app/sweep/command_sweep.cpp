#include "app/sweep/command_sweep.hpp"

#include <vector>

#include "app/memory_option.hpp"
#include "app/output_name.hpp"
#include "core/parallel.hpp"

namespace thinwall::app {

namespace {

/// The options of a sweep that other processes compute; `alone` are those that make no sense with it.
void describe_jobs(CLI::App& command, SweepRequest& sweep, const std::vector<CLI::Option*>& alone) {
  auto* slurm = command.add_flag("--slurm", sweep.slurm, "write the job array of Slurm instead: a task a shard");
  auto* parallel = command.add_flag("--parallel", sweep.parallel, "write a script of GNU parallel instead");
  for (CLI::Option* other : alone) {
    slurm->excludes(other);
    parallel->excludes(other);
  }
  command.add_option("--shards", sweep.shards, "shards of the jobs (default: one a point, 100 at most)")
      ->type_name("N")
      ->check(CLI::Range(1, 100000));
  command.add_flag("--submit", sweep.submit, "hand the array to sbatch, and the table after it")->needs(slurm);
  command.add_option("--sbatch", sweep.sbatch, "a further option of sbatch: --sbatch=--partition=long")
      ->type_name("OPTION")
      ->allow_extra_args(false)
      ->needs(slurm);
}

}  // namespace

void describe_sweep(CLI::App& app, SweepRequest& sweep, MergeRequest& merge) {
  auto* command =
      app.add_subcommand("sweep", "a case at every point of a grid of its keys, with a table of the answers");
  command->add_option("CASE", sweep.case_path, "a folder with a case.toml, or the file")->type_name("PATH")->required();
  command
      ->add_option("KEYS", sweep.keys,
                   "part.thickness=\"4 mm:8 mm:0.5 mm\" (from, to, step) or part.thickness=\"4 mm, 6 mm\"; the last "
                   "goes fastest")
      ->type_name("KEY=VALUES")
      ->required();
  command->add_option("--set", sweep.overrides, "a value put over the case at every point")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("--out", sweep.out, "folder of the sweep (default: results/<case>-sweep)")
      ->type_name("DIR")
      ->check(has_a_name);
  auto* shard = command->add_option("--shard", sweep.shard, "every n-th point from the i-th on, for job arrays")
                    ->type_name("I/N");
  auto* fresh = command->add_flag("--fresh", sweep.fresh, "compute the points that are there already, too");
  command
      ->add_option_function<int>(
          "--threads",
          [&sweep](int threads) {
            sweep.threads = threads;
            core::set_thread_count(threads);
          },
          "threads to use (default: all; of a job: one)")
      ->check(CLI::Range(1, 1024));
  add_memory_option(*command);
  describe_jobs(*command, sweep, {shard, fresh});
  auto* quiet = command->add_flag_callback(
      "-q,--quiet", [&sweep] { sweep.verbosity = -1; }, "log warnings only");
  command
      ->add_flag_callback(
          "-v,--verbose", [&sweep] { sweep.verbosity = 1; }, "log everything")
      ->excludes(quiet);
  command
      ->add_option("--progress", sweep.progress,
                   "stage, count and time left of each point (default: auto, on a terminal and not with -q)")
      ->type_name("auto|always|never");
  auto* merge_command = app.add_subcommand("merge", "the table of a sweep from the folders of its shards");
  merge_command->add_option("FOLDERS", merge.folders, "folders of the sweep's shards")->type_name("DIR")->required();
  merge_command->add_option("-o,--out", merge.out, "folder for the table")
      ->type_name("DIR")
      ->required()
      ->check(has_a_name);
}

}  // namespace thinwall::app

#include "app/sweep/command_sweep.hpp"

#include "app/memory_option.hpp"
#include "core/parallel.hpp"

namespace thinwall::app {

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
  command->add_option("--out", sweep.out, "folder of the sweep (default: results/<case>-sweep)")->type_name("DIR");
  command->add_option("--shard", sweep.shard, "every n-th point from the i-th on, for job arrays")->type_name("I/N");
  command->add_flag("--fresh", sweep.fresh, "compute the points that are there already, too");
  command->add_option_function<int>("--threads", core::set_thread_count, "threads to use (default: all)")
      ->check(CLI::Range(1, 1024));
  add_memory_option(*command);
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
  merge_command->add_option("-o,--out", merge.out, "folder for the table")->type_name("DIR")->required();
}

}  // namespace thinwall::app

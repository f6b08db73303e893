#pragma once
// Scripts that compute the shards of a sweep on many processors: a job array of Slurm, and a line of GNU parallel.

#include <filesystem>
#include <string>
#include <vector>

namespace thinwall::app {

/// The shards of one sweep as jobs.
struct SweepJobs {
  std::string name;                    ///< of the job
  std::string program;                 ///< the file that is run
  std::vector<std::string> sweep;      ///< its arguments, without --shard
  std::filesystem::path folder;        ///< of the sweep, shared by all nodes; an absolute path
  std::filesystem::path from;          ///< the folder in which the jobs run, to which other paths are relative
  std::size_t shards = 1;              ///< tasks of the array
  int threads = 1;                     ///< of a task
  double seconds = 0.0;                ///< of a shard
  double memory_bytes = 0.0;           ///< of a shard; 0: what the cluster gives
  std::vector<std::string> options{};  ///< further ones of sbatch: "--partition=long"
};

/// The text as one word of a shell.
[[nodiscard]] std::string shell_word(const std::string& text);

/// FOLDER/shards.sbatch: one task a shard. A task whose node fails or whose program is killed is queued again and
/// goes on where it stopped; after the second time it leaves shards/I.killed. One that Slurm ends at its limit of time,
/// thrice the seconds and a minute at least, leaves shards/I.starts. `thinwall merge` tells of both.
[[nodiscard]] std::string slurm_array(const SweepJobs& jobs);

/// FOLDER/merge.sbatch: the table of all shards in FOLDER/merged, to be run after the array.
[[nodiscard]] std::string slurm_merge(const SweepJobs& jobs);

/// FOLDER/parallel.sh: the same by GNU parallel on one machine, which goes on with the shards that are missing when it
/// is run again.
[[nodiscard]] std::string parallel_script(const SweepJobs& jobs);

/// A shard of a sweep's folder that has not come to its end.
struct OpenShard {
  std::string number;
  bool given_up = false;  ///< killed twice; else it runs, or was killed and not queued again
};

/// The shards that have begun and not ended, in the order of their names.
[[nodiscard]] std::vector<OpenShard> open_shards(const std::filesystem::path& folder);

/// Writes the scripts of Slurm to the folder and returns their paths; throws DataError.
struct SlurmScripts {
  std::filesystem::path array, merge;
};
[[nodiscard]] SlurmScripts write_slurm_scripts(const SweepJobs& jobs);

/// Hands both to sbatch, the table after the array; returns the number of the array's job. Throws DataError with what
/// sbatch says.
[[nodiscard]] std::string submit(const SlurmScripts& scripts);

}  // namespace thinwall::app

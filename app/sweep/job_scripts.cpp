#include "app/sweep/job_scripts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <system_error>

#include "core/atomic_file.hpp"
#include "core/error.hpp"

namespace thinwall::app {

namespace {

namespace fs = std::filesystem;

std::string command(const SweepJobs& jobs, const std::vector<std::string>& arguments) {
  std::string line = shell_word(jobs.program);
  for (const std::string& argument : arguments) line += ' ' + shell_word(argument);
  return line;
}

/// The line that computes a shard, whose number the shell puts in.
std::string shard_command(const SweepJobs& jobs, const std::string& number) {
  return command(jobs, jobs.sweep) + " --shard " + number + '/' + std::to_string(jobs.shards);
}

std::string merge_command(const SweepJobs& jobs) {
  return command(jobs, {"merge", jobs.folder.string(), "-o", (jobs.folder / "merged").string()});
}

/// The text as a value in a line of options for sbatch.
std::string option_value(const std::string& text) {
  std::string value = "\"";
  for (const char c : text) value += c == '"' || c == '\\' ? std::string{'\\', c} : std::string(1, c);
  return value + '"';
}

/// The path of a log with every % doubled, which would begin a replacement.
std::string log_path(const fs::path& folder, const std::string& name) {
  std::string path;
  for (const char c : (folder / "").string()) path += c == '%' ? std::string("%%") : std::string(1, c);
  return option_value(path + name);
}

std::string header(const SweepJobs& jobs, const std::string& of) {
  std::string text = "#!/bin/bash\n#SBATCH --job-name=" + option_value(jobs.name + of) +
                     "\n#SBATCH --chdir=" + option_value(jobs.from.string()) + "\n#SBATCH --open-mode=append\n";
  for (const std::string& option : jobs.options) text += "#SBATCH " + option + '\n';
  return text;
}

/// The number of the job that sbatch makes of a script; sbatch itself says on standard error what is wrong. Throws
/// DataError where it takes none, with `next`, what to do then.
std::string submitted(const std::string& arguments, const std::string& next) {
  std::FILE* pipe = ::popen(("sbatch --parsable " + arguments).c_str(), "r");
  std::string text;
  for (int c = pipe == nullptr ? EOF : std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
  const bool ended = pipe != nullptr && ::pclose(pipe) == 0;
  const std::string job = text.substr(0, text.find_first_of(";\n"));  // "12;cluster" where there are several
  const bool is_number = !job.empty() && std::ranges::all_of(job, [](char c) { return c >= '0' && c <= '9'; });
  if (!ended || !is_number) throw core::DataError("sbatch did not take the sweep; " + next);
  return job;
}

}  // namespace

std::string shell_word(const std::string& text) {
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("-_./=,:+@%").find(c) != std::string_view::npos;
  };
  if (!text.empty() && std::ranges::all_of(text, is_plain)) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + '\'';
}

std::string slurm_array(const SweepJobs& jobs) {
  const double minutes = std::max(1.0, std::ceil(3.0 * jobs.seconds / 60.0));
  std::string text = header(jobs, "");
  text += fmt::format("#SBATCH --array=1-{}\n#SBATCH --cpus-per-task={}\n#SBATCH --time={:.0f}\n", jobs.shards,
                      jobs.threads, minutes);
  if (jobs.memory_bytes > 0.0) text += fmt::format("#SBATCH --mem={:.0f}M\n", std::ceil(jobs.memory_bytes / 1048576.0));
  const fs::path shards = jobs.folder / "shards";
  text += "#SBATCH --requeue\n#SBATCH --output=" + log_path(shards, "%a.log") + '\n';
  return text + "\nshard=$SLURM_ARRAY_TASK_ID\nstarts=" + shell_word((shards / "").string()) + R"sh($shard.starts
# A line is left behind by each start that was killed: with its node, for its memory, or by somebody.
echo "$(date --iso-8601=seconds) $(hostname)" >> "$starts"
if [[ $(wc -l < "$starts") -gt 2 ]]; then
  mv "$starts" "${starts%.starts}.killed"
  echo "shard $shard was killed twice and is given up" >&2
  exit 1
fi
)sh" + shard_command(jobs, "\"$shard\"") +
         R"sh(
code=$?
# Above 128 a signal has ended the program: the shard is queued again and goes on where it stopped.
if [[ $code -gt 128 ]]; then
  scontrol requeue "$SLURM_JOB_ID"
  exit $code
fi
rm -f "$starts" "${starts%.starts}.killed"
exit $code
)sh";
}

std::string slurm_merge(const SweepJobs& jobs) {
  return header(jobs, "-merge") +
         "#SBATCH --ntasks=1\n#SBATCH --time=10\n#SBATCH --output=" + (jobs.folder / "shards" / "merge.log").string() +
         "\n\n" + merge_command(jobs) + '\n';
}

std::string parallel_script(const SweepJobs& jobs) {
  return "#!/bin/bash\n# Each shard goes on where it stopped when this is run again.\ncd " +
         shell_word(jobs.from.string()) + " || exit 1\nparallel --jobs \"${JOBS:-$(( ($(nproc) + " +
         std::to_string(jobs.threads - 1) + ") / " + std::to_string(jobs.threads) + " ))}\" --joblog " +
         shell_word((jobs.folder / "shards" / "joblog").string()) + " --resume-failed " +
         shell_word(shard_command(jobs, "{}")) + " ::: {1.." + std::to_string(jobs.shards) + "}\n" +
         merge_command(jobs) + '\n';
}

std::vector<OpenShard> open_shards(const fs::path& folder) {
  std::vector<OpenShard> shards;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "shards", none)) {
    const bool given_up = entry.path().extension() == ".killed";
    if (given_up || entry.path().extension() == ".starts") shards.push_back({entry.path().stem().string(), given_up});
  }
  std::ranges::sort(shards, {}, &OpenShard::number);
  return shards;
}

SlurmScripts write_slurm_scripts(const SweepJobs& jobs) {
  const SlurmScripts scripts{jobs.folder / "shards.sbatch", jobs.folder / "merge.sbatch"};
  core::write_file_atomically(scripts.array, slurm_array(jobs));
  core::write_file_atomically(scripts.merge, slurm_merge(jobs));
  return scripts;
}

std::string submit(const SlurmScripts& scripts) {
  std::string job = submitted(shell_word(scripts.array.string()), "submit its script by hand, or use --parallel");
  const std::string merge = "--dependency=afterany:" + job + ' ' + shell_word(scripts.merge.string());
  (void)submitted(merge, "the array is queued as job " + job + ", the table is not: sbatch " + merge);
  return job;
}

}  // namespace thinwall::app

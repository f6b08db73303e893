#include "app/ranks_option.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <string>

#include "core/error.hpp"
#include "core/memory.hpp"
#include "core/messages.hpp"
#include "core/parallel.hpp"

namespace thinwall::app {

void add_ranks_option(CLI::App& command, RanksRequest& request) {
  command
      .add_option("--ranks", request.ranks,
                  "processes of MPI that factorise large matrices, each with its share of the threads (default: 1)")
      ->check(CLI::Range(1, 4096));
  command.add_flag("--low-memory", request.low_memory,
                   "large factors are kept on disk, in TMPDIR, by processes of MPI, also by a single one");
}

namespace {

/// The number of processes that an mpirun or srun started together with this one; 0 if it was started by itself.
int started_together() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}) {
    const char* value = std::getenv(name);
    if (value != nullptr && std::atoi(value) > 0) return std::atoi(value);
  }
  return 0;
}

/// Ranks of this machine's own mpirun need so much memory before they have any matrix (docs/scaling.md, Eq. 1).
void require_memory_of_idle_ranks(int ranks) {
  constexpr double idle_bytes = 40e6;
  if (std::getenv("THINWALL_MPIRUN") == nullptr)
    core::require_memory(idle_bytes * ranks, "--ranks: " + std::to_string(ranks) + " processes on this machine");
}

}  // namespace

std::unique_ptr<distributed::DistributedFactors> start_ranks(const RanksRequest& request) {
  const int together = started_together();
  const bool wanted = request.ranks > 1 || request.low_memory;
  if (wanted && (together > 1 || std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr))
    throw core::UsageError("--ranks and --low-memory: an mpirun or srun has started this program, as one of " +
                           std::to_string(together) + "; start it without one: it starts its " +
                           std::to_string(request.ranks) + " ranks itself, by what THINWALL_MPIRUN names");
  if (together > 1)
    core::warn("an mpirun or srun has started " + std::to_string(together) +
               " of this program, each of which does the whole work by itself; for one work on so many processes start "
               "it without one, with --ranks " +
               std::to_string(together));
  if (!wanted) return nullptr;
  require_memory_of_idle_ranks(request.ranks);
  const int threads = core::thread_count();
  distributed::TeamOptions options;
  options.ranks = request.ranks;
  options.threads = std::max(1, threads / request.ranks);
  options.on_disk = request.low_memory;
  if (request.ranks > threads)
    core::warn("--ranks: " + std::to_string(request.ranks) + " ranks share " + std::to_string(threads) +
               " threads of this machine, which takes longer than as many ranks as threads");
  return std::make_unique<distributed::DistributedFactors>(options);
}

}  // namespace thinwall::app

#include "app/ranks_option.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>

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

std::unique_ptr<distributed::DistributedFactors> start_ranks(const RanksRequest& request) {
  if (request.ranks <= 1 && !request.low_memory) return nullptr;
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

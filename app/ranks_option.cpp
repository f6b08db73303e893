#include "app/ranks_option.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>

#include "core/messages.hpp"
#include "core/parallel.hpp"

namespace thinwall::app {

void add_ranks_option(CLI::App& command, int& ranks) {
  command
      .add_option("--ranks", ranks,
                  "processes of MPI that factorise large matrices, each with its share of the threads (default: 1)")
      ->check(CLI::Range(1, 4096));
}

std::unique_ptr<distributed::DistributedFactors> start_ranks(int ranks) {
  if (ranks <= 1) return nullptr;
  const int threads = core::thread_count();
  distributed::TeamOptions options;
  options.ranks = ranks;
  options.threads = std::max(1, threads / ranks);
  if (ranks > threads)
    core::warn("--ranks: " + std::to_string(ranks) + " ranks share " + std::to_string(threads) +
               " threads of this machine, which takes longer than as many ranks as threads");
  return std::make_unique<distributed::DistributedFactors>(options);
}

}  // namespace thinwall::app

#pragma once
// The option --ranks: processes of MPI that factorise large matrices.

#include <memory>

#include "distributed/rank_team.hpp"

namespace CLI {
class App;
}

namespace thinwall::app {

/// The words of the command line on ranks.
struct RanksRequest {
  int ranks = 1;
  bool low_memory = false;  ///< the factors go to disk
};

/// Adds --ranks and --low-memory to a command.
void add_ranks_option(CLI::App& command, RanksRequest& request);

/// The ranks, which factorise for this process as long as the object lives; each has its share of the process's
/// threads. Null for one rank with its factors in memory, which this process itself is. Throws UsageError where an
/// mpirun has started this process itself, NumericalError for more ranks than the machine has memory for, and as
/// distributed::RankTeam. Warns where several processes do the same work.
[[nodiscard]] std::unique_ptr<distributed::DistributedFactors> start_ranks(const RanksRequest& request);

}  // namespace thinwall::app

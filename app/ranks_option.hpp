#pragma once
// The option --ranks: processes of MPI that factorise large matrices.

#include <memory>

#include "distributed/rank_team.hpp"

namespace CLI {
class App;
}

namespace thinwall::app {

/// Adds --ranks to a command; `ranks` is its value, 1 without the option.
void add_ranks_option(CLI::App& command, int& ranks);

/// The ranks, which factorise for this process as long as the object lives; each has its share of the process's
/// threads. Null for one rank, which this process itself is. Throws as distributed::RankTeam.
[[nodiscard]] std::unique_ptr<distributed::DistributedFactors> start_ranks(int ranks);

}  // namespace thinwall::app

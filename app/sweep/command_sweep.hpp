#pragma once
// The words of `thinwall sweep` and `thinwall merge`.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/sweep/sweep.hpp"

namespace thinwall::app {

struct MergeRequest {
  std::vector<std::string> folders;
  std::string out;
};

/// Adds both commands to `app`; what the words say goes to the requests.
void describe_sweep(CLI::App& app, SweepRequest& sweep, MergeRequest& merge);

}  // namespace thinwall::app

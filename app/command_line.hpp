#pragma once
// The words of the command line (design: run, lobes, sweep, check, init, compare, doctor).

#include <ostream>

#include "app/case_run.hpp"

namespace thinwall::app {

/// Runs one command. Results go to `out`, the log and every error to `err`, a line each. Returns the exit code: 0 done,
/// 1 internal error, 2 usage, 3 invalid case, 4 unreadable data, 5 numerical failure, 6 an expectation does not hold
/// (for `compare`: the results differ), 130 interrupted. Throws nothing.
int run_command_line(int argc, const char* const* argv, const RunCase& run, std::ostream& out, std::ostream& err);

}  // namespace thinwall::app

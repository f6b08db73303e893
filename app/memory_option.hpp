#pragma once
// The option --memory: how much the whole process may hold.

#include <CLI/CLI.hpp>

namespace thinwall::app {

/// Adds --memory to a command. Stages that would need more than is left are refused (core::require_memory()), and a
/// process that comes to hold more all the same ends at once with one line and exit code 5; a result folder is then as
/// it was before the run. Text that is no memory is an InputError.
void add_memory_option(CLI::App& command);

}  // namespace thinwall::app

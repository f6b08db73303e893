#pragma once
// Completion of the command line in a shell.

#include <string>
#include <vector>

#include "app/command_description.hpp"

namespace thinwall::app {

/// The shells that completion_script() knows: bash, zsh, fish.
[[nodiscard]] std::vector<std::string> completed_shells();

/// A script that teaches a shell the commands, their options and choices, files where they want files, folders and case
/// files where they want a case, and the keys of a case for --set and sweeps. Throws UsageError for another shell.
[[nodiscard]] std::string completion_script(const ProgramDescription& program, const std::string& shell);

}  // namespace thinwall::app

#pragma once
// Words of the command line that mean nothing.

#include <string>
#include <vector>

#include "app/command_description.hpp"

namespace thinwall::app {

/// The first of `words` (without the program's name) that is no command where one is expected, or no option of its
/// command, with the nearest that there is and where all are listed; "" if all are known. It takes every word that
/// starts with --, and -o or another that is meant as one (core::synonyms()), for an option, so it is asked only of a
/// command line that could not be read.
[[nodiscard]] std::string unknown_word(const ProgramDescription& program, const std::vector<std::string>& words);

}  // namespace thinwall::app

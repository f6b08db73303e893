#pragma once
// The log: to stderr, and whole to run.log.

#include <filesystem>

namespace thinwall::app {

/// Sends spdlog's default logger to stderr. −1: warnings only, 0: information, 1: everything. `over_a_line`: on a
/// terminal whose last line is overwritten (Stages), so that each message clears it first.
void log_to_terminal(int verbosity, bool over_a_line = false);

/// From now on also to `file` (replaced), in full. Throws DataError if it cannot be opened.
void log_to_file(const std::filesystem::path& file);

/// From now on the messages of the library go to spdlog's default logger.
void messages_to_log();

}  // namespace thinwall::app

#pragma once
// The lesson of the cuts that were made: as a section of summary.json, as a table, in words.

#include <filesystem>
#include <string>

#include "report/summary/learned.hpp"
#include "study/results.hpp"

namespace thinwall::report {

/// The section of a chart that learned.
[[nodiscard]] LearnedSummary learned_summary(const study::LearnedChart& learned);

/// Writes the limits over the speeds, beforehand and after. Throws DataError if the file cannot be written.
void write_learned(const std::filesystem::path& file, const LearnedSummary& learned);

/// Lines for the terminal, indented by four: the shares that are right, every parameter, cuts that contradict, and the
/// next cut.
[[nodiscard]] std::string learned_text(const LearnedSummary& learned);

}  // namespace thinwall::report

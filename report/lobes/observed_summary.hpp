#pragma once
// Cuts that were made, held against a chart: as a section of summary.json, as a table, in words.

#include <filesystem>
#include <string>
#include <vector>

#include "milling/observed/score.hpp"
#include "report/summary/observed.hpp"

namespace thinwall::report {

/// The section of judged cuts.
[[nodiscard]] ObservedSummary observed_summary(const std::vector<study::JudgedCut>& cuts);

/// Writes a row for each cut. Throws DataError if the file cannot be written.
void write_observed(const std::filesystem::path& file, const ObservedSummary& observed);

/// A score with its interval.
[[nodiscard]] ShareSummary share_summary(const milling::Score& score);

/// "41 of 46 right (89 %, 95 % interval 77 to 95 %)".
[[nodiscard]] std::string share_text(const ShareSummary& share);

/// Lines for the terminal, indented by four: the share, the textbook's, what is certain, and every wrong cut with its
/// margins.
[[nodiscard]] std::string observed_text(const ObservedSummary& observed);

}  // namespace thinwall::report

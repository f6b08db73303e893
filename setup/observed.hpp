#pragma once
// Cuts that were made with the set-up, against which its charts are judged.

#include <filesystem>
#include <vector>

#include "milling/observed/observed_cut.hpp"

namespace thinwall::setup {

/// An entry of the case: one cut, or those of a file.
struct ObservedCuts {
  std::filesystem::path file;              ///< empty: the cut is given
  std::vector<milling::ObservedCut> cuts;  ///< of a file empty until it is read
};

/// The cuts of all entries in their order.
[[nodiscard]] std::vector<milling::ObservedCut> all_cuts(const std::vector<ObservedCuts>& entries);

/// Columns spindle_speed_rpm, depth_mm or depth_m, observed (stable, chatter, marginal) and, where it was heard,
/// chatter_frequency_hz, whose cells may be empty; others are passed over. Throws DataError, with the file and the line
/// of the table, for a column that is absent, another word, and a number that is not above 0.
[[nodiscard]] std::vector<milling::ObservedCut> read_observed_cuts(const std::filesystem::path& path);

}  // namespace thinwall::setup

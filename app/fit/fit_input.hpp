#pragma once
// From the words of `thinwall fit` to a measured matrix.

#include <string>
#include <vector>

#include "dynamics/response_model.hpp"

namespace thinwall::app {

/// Files of FRFs, and what they do not say themselves.
struct FitInput {
  /// FILE or ENTRY=FILE, with ENTRY "P.x/Q.y" (response/force), or "x" or "xy" at the tool's tip; FILE alone is x.
  /// Entries of files that tell their DOFs are those.
  std::vector<std::string> sources;
  std::string quantity, unit, frequency_unit;
  std::string variable, frequency_variable, coherence_variable;  ///< of another program's MAT file: "H", "f", "coh"
  std::string responses, forces;  ///< DOFs of the variable's array, "1.x, 2.x"; empty: it is one FRF
  std::string geometry;           ///< file of the points' places; empty: those of universal files among the sources
};

/// All entries as a matrix, with the coherence of its entries at each line (empty unless all have one).
struct FitMatrix {
  dynamics::ResponseModel measured;
  std::vector<Eigen::MatrixXd> coherence;
  std::vector<std::string> notes;
  std::vector<std::string> files;
};

/// Reads the files. An entry that no file gives is that of its transpose, with a note, where that is there. Throws
/// UsageError for words that do not go together, and as setup::read_all_measured() and io::response_matrix(), which
/// names entries that are missing or stand twice and axes that differ.
[[nodiscard]] FitMatrix fit_matrix(const FitInput& input);

/// The file of a word of `sources`.
[[nodiscard]] std::string file_of(const std::string& word);

}  // namespace thinwall::app

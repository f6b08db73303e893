#pragma once
// `thinwall fit`: a modal model from measured FRFs.

#include <optional>
#include <string>
#include <vector>

#include "app/fit/fit_input.hpp"

namespace thinwall::app {

/// The words of the command.
struct FitRequest {
  FitInput input;
  std::vector<std::string> sensors;   ///< "1=30 g": masses that sat at a point while all was measured
  std::string swap;                   ///< file with the [tool.swap] that the FRFs go through; empty: none
  std::string from, to;               ///< "20 Hz"; empty: all lines
  std::vector<std::string> left_out;  ///< "50 Hz", lines within 1 % of it, or "49 Hz:51 Hz"
  std::string poles;                  ///< "10.4 Hz, 27 Hz"; empty: chosen from the diagram
  int order = 30;                     ///< highest one of the diagram
  std::string terms;                  ///< as identification::terms_named(); empty: as many as the lines call for
  std::string residues;               ///< empty: of rank one, or free where a pole is double
  std::optional<int> averages;        ///< that the coherence belongs to
  std::optional<double> noise;
  bool passive = false;  ///< residues are moved until the fit gives no energy
  std::string out = "fit";
};

/// Reads, fits and writes the folder that report::write_fit() tells. Returns the text for the terminal. Throws
/// UsageError for options that cannot be read, and as fit_matrix(), free_of_sensors(),
/// with_other_tool() and identification::fit_response().
[[nodiscard]] std::string fit_files(const FitRequest& request);

}  // namespace thinwall::app

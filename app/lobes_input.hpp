#pragma once
// From the words of `thinwall lobes` to a case: what moves from CSV files, what cuts from a TOML file.

#include <string>
#include <vector>

#include "case/machining_case.hpp"
#include "milling/chart/operating_point.hpp"

namespace thinwall::app {

struct LobesInput {
  /// A case (folder or .toml), or CSV files: one table of modes, or FRFs of the tool tip, each FILE or ENTRY=FILE with
  /// ENTRY the response and force directions in the part's axes, "x" (both), "xy" …; FILE alone is x.
  std::vector<std::string> sources;
  std::string tool;  ///< TOML with [tool], [cutting], [lobes]; with CSV files only
  std::vector<std::string> overrides;
  std::string quantity, unit;  ///< of FRFs; nothing is assumed
  std::string frequency_unit;  ///< empty: Hz
};

/// The case to compute. From CSV files it is the tool's TOML with the values of [[tool.measured]] or [[tool.modes]]
/// added, which its text has as well, so that the case of the results can be run again. A table of modes has the
/// columns frequency_hz, damping_ratio, stiffness (N/m) or mass (kg), and direction ("x", "-y"; x where there is no
/// such column) or direction_x, direction_y, direction_z. Throws UsageError for words that do not go together,
/// CaseError for a case or tool with errors, InputError for a case without [lobes], DataError (file and line) for
/// unreadable files or a mode that no structure has.
[[nodiscard]] cases::Case lobes_case(const LobesInput& input);

/// "5000 rpm, 0.5 mm". Throws UsageError: anything else, a wrong unit, zero or less.
[[nodiscard]] milling::OperatingPoint operating_point(const std::string& text);

}  // namespace thinwall::app

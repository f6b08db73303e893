#pragma once
// The tool with which FRFs were measured, exchanged for another in the FRFs of `thinwall fit`.

#include <string>
#include <vector>

#include "app/fit/fit_input.hpp"

namespace thinwall::app {

/// Exchanges the first tool of a file's [tool.swap] for the second in a matrix that was measured at the tip and at a
/// point up the tool, in two directions across it (study::swapped_response()): what is left are the receptances of the
/// tip with the second tool, without coherence. Returns a doubt where digits are lost; does nothing without a file.
/// Throws UsageError for a file without [tool.swap] or with FRFs in it, and a matrix with other points; errors as
/// cases::read_tool() and study::swapped_response(). Cost: that of the swap.
[[nodiscard]] std::vector<std::string> with_other_tool(FitMatrix& matrix, const std::string& file);

}  // namespace thinwall::app

#pragma once
// The tool with which FRFs were measured, exchanged for another in the FRFs of `thinwall fit`.

#include <string>
#include <vector>

#include "app/fit/fit_input.hpp"
#include "identification/fit_response.hpp"

namespace thinwall::app {

/// Exchanges the first tool of a file's [tool.swap] for the second in a matrix that was measured at the tip and at a
/// point up the tool, in two directions across it (study::swapped_response()): what is left are the receptances of the
/// tip with the second tool on the lines that the fit uses, without coherence. Forces may stand in another order than
/// responses. Returns a doubt where digits are lost; does nothing without a file. Throws UsageError for a file without
/// [tool.swap], with FRFs in it or with tool.swap.to, and a matrix with other points; errors as cases::read_tool(),
/// identification::used_lines() and study::swapped_response(). Cost: that of the swap.
[[nodiscard]] std::vector<std::string> with_other_tool(FitMatrix& matrix, const std::string& file,
                                                       const identification::ResponseFitOptions& options);

}  // namespace thinwall::app

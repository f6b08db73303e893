#pragma once
// The summary of a chart along a path: for summary.json and for the terminal.

#include <string>

#include "report/summary/summary.hpp"
#include "setup/machining_setup.hpp"
#include "study/results.hpp"

namespace thinwall::report {

/// An entry of `path` in summary.json: the least depth of every position with its speed, the weakest of them, and the
/// speed at which the whole path allows the most, with the position that limits it there, and the same at the case's
/// own speed, if it has one. Positions are numbered from 1.
[[nodiscard]] PathSummary path_summary(const setup::Setup& source, const study::PathLobes& path);

/// Three lines for every chart along the path of a summary; empty if it has none.
[[nodiscard]] std::string path_text(const Summary& summary);

}  // namespace thinwall::report

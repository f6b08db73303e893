#pragma once
// The summary of what a run has computed.

#include "report/summary/summary.hpp"
#include "setup/machining_setup.hpp"
#include "study/results.hpp"

namespace thinwall::report {

/// The summary of a run without its checks; the name and the title of its case are left empty for the caller.
[[nodiscard]] Summary summary_of(const setup::Setup& source, const study::Results& results);

}  // namespace thinwall::report

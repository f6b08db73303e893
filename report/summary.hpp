#pragma once
// summary.json: everything that a person or a script wants first (names carry units).

#include <nlohmann/json.hpp>
#include <vector>

#include "setup/machining_setup.hpp"
#include "study/results.hpp"

namespace thinwall::report {

/// The summary of a run without its checks; the name and the title of its case are left empty for the caller.
[[nodiscard]] nlohmann::json summary_of(const setup::Setup& source, const study::Results& results);

}  // namespace thinwall::report

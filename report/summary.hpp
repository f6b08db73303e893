#pragma once
// summary.json: everything that a person or a script wants first (names carry units).

#include <nlohmann/json.hpp>
#include <vector>

#include "case/case.hpp"
#include "case/expectation.hpp"
#include "study/results.hpp"

namespace thinwall::report {

/// The summary of a run without its checks.
[[nodiscard]] nlohmann::json summary_of(const cases::Case& source, const study::Results& results);

/// Adds the checks and returns whether all hold.
bool add_checks(nlohmann::json& summary, const std::vector<cases::Expectation>& expectations);

}  // namespace thinwall::report

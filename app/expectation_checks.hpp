#pragma once
// The expectations of a case, held against its summary.

#include <nlohmann/json.hpp>
#include <vector>

#include "case/expectation.hpp"

namespace thinwall::app {

/// Adds the checks and returns whether all hold.
bool add_checks(nlohmann::json& summary, const std::vector<cases::Expectation>& expectations);

}  // namespace thinwall::app

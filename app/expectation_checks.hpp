#pragma once
// The expectations of a case, held against its summary.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "case/expectation.hpp"
#include "report/summary/summary.hpp"

namespace thinwall::app {

/// An expectation beside what the run gave, its value filled in from `same_as`. `actual` is empty if the summary has no
/// such number.
struct ExpectationResult {
  cases::Expectation expected;
  std::optional<double> actual;
  bool ok = false;
};

/// The number at a path of the summary, "lobes[1].minimum_depth_m"; empty if there is none.
[[nodiscard]] std::optional<double> number_at(const nlohmann::json& summary, const std::string& path);

/// Holds if |actual − value| ≤ tolerance (or ≤ relative·|value|), at_least ≤ actual ≤ at_most, whichever are given; a
/// quantity, or one it is compared with, that the summary lacks, or that is not finite, does not hold.
[[nodiscard]] ExpectationResult compare(const cases::Expectation& expected, const nlohmann::json& summary);

/// Adds the checks and returns whether all hold.
bool add_checks(report::Summary& summary, const std::vector<cases::Expectation>& expectations);

}  // namespace thinwall::app

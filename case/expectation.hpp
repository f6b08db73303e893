#pragma once
// Figures that a case is expected to reproduce, with where they come from.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace thinwall::cases {

struct Expectation {
  std::string name;
  std::string quantity;  ///< path into summary.json, "coupling.modes[0].frequency_hz"
  std::optional<double> value, tolerance, relative, at_least, at_most;
  std::string origin;        ///< published, analytic, another program, recorded
  std::string same_as = {};  ///< path of the number that stands in place of `value`; empty: none
};

/// An expectation beside what the run gave, its value filled in from `same_as`. `actual` is empty if the summary has no
/// such number.
struct ExpectationResult {
  Expectation expected;
  std::optional<double> actual;
  bool ok = false;
};

/// The number at a path of the summary, "lobes[1].minimum_depth_m"; empty if there is none.
[[nodiscard]] std::optional<double> number_at(const nlohmann::json& summary, const std::string& path);

/// Holds if |actual − value| ≤ tolerance (or ≤ relative·|value|), at_least ≤ actual ≤ at_most, whichever are given; a
/// quantity, or one it is compared with, that the summary lacks, or that is not finite, does not hold.
[[nodiscard]] ExpectationResult compare(const Expectation& expected, const nlohmann::json& summary);

}  // namespace thinwall::cases

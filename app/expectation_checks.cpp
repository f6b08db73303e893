#include "app/expectation_checks.hpp"

#include <cmath>

namespace thinwall::app {

using nlohmann::json;

bool add_checks(json& summary, const std::vector<cases::Expectation>& expectations) {
  bool all = true;
  for (const cases::Expectation& wanted : expectations) {
    const cases::ExpectationResult result = cases::compare(wanted, summary);
    const cases::Expectation& expected = result.expected;
    json check = {
        {"name", expected.name}, {"quantity", expected.quantity}, {"origin", expected.origin}, {"ok", result.ok}};
    check["value"] = result.actual ? json(*result.actual) : json(nullptr);
    check["expected"] = expected.value ? json(*expected.value) : json(nullptr);
    if (expected.tolerance) check["tolerance"] = *expected.tolerance;
    if (expected.relative && expected.value) check["tolerance"] = *expected.relative * std::abs(*expected.value);
    if (expected.at_least) check["at_least"] = *expected.at_least;
    if (expected.at_most) check["at_most"] = *expected.at_most;
    summary["checks"].push_back(check);
    all = all && result.ok;
  }
  return all;
}

}  // namespace thinwall::app

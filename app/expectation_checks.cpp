#include "app/expectation_checks.hpp"

#include <charconv>
#include <cmath>
#include <string_view>

#include "report/summary/summary_json.hpp"

namespace thinwall::app {

using nlohmann::json;

namespace {

/// Takes "name", "[3]" or "." off the front of `path` and steps from `node`; nullptr where there is nothing.
const nlohmann::json* step(const nlohmann::json* node, std::string_view& path) {
  if (path.front() == '.') path.remove_prefix(1);
  if (path.empty()) return nullptr;
  if (path.front() == '[') {
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(path.data() + 1, path.data() + path.size(), index);
    if (error != std::errc() || end == path.data() + path.size() || *end != ']') return nullptr;
    path.remove_prefix(static_cast<std::size_t>(end - path.data()) + 1);
    return node->is_array() && index < node->size() ? &(*node)[index] : nullptr;
  }
  const std::string name(path.substr(0, path.find_first_of(".[")));
  path.remove_prefix(name.size());
  const auto found = node->find(name);
  return node->is_object() && found != node->end() ? &*found : nullptr;
}

}  // namespace

std::optional<double> number_at(const nlohmann::json& summary, const std::string& path) {
  const nlohmann::json* node = &summary;
  std::string_view rest = path;
  while (node != nullptr && !rest.empty()) node = step(node, rest);
  if (node == nullptr || !node->is_number()) return std::nullopt;
  return node->get<double>();
}

ExpectationResult compare(const cases::Expectation& expected, const nlohmann::json& summary) {
  ExpectationResult result{expected, number_at(summary, expected.quantity), false};
  if (!expected.same_as.empty()) result.expected.value = number_at(summary, expected.same_as);
  if (!result.actual || !std::isfinite(*result.actual)) return result;
  if (!expected.same_as.empty() && !result.expected.value) return result;
  const double actual = *result.actual;
  result.ok = true;
  if (const auto& value = result.expected.value) {
    const double allowed = expected.tolerance.value_or(0.0) + expected.relative.value_or(0.0) * std::abs(*value);
    result.ok = std::abs(actual - *value) <= allowed;
  }
  if (expected.at_least) result.ok = result.ok && actual >= *expected.at_least;
  if (expected.at_most) result.ok = result.ok && actual <= *expected.at_most;
  return result;
}

bool add_checks(report::Summary& summary, const std::vector<cases::Expectation>& expectations) {
  const json figures = report::summary_json(summary);
  bool all = true;
  for (const cases::Expectation& wanted : expectations) {
    const ExpectationResult result = compare(wanted, figures);
    const cases::Expectation& expected = result.expected;
    report::CheckSummary check{.name = expected.name,
                               .quantity = expected.quantity,
                               .origin = expected.origin,
                               .ok = result.ok,
                               .value = result.actual,
                               .expected = expected.value,
                               .tolerance = expected.tolerance,
                               .at_least = expected.at_least,
                               .at_most = expected.at_most};
    if (expected.relative && expected.value) check.tolerance = *expected.relative * std::abs(*expected.value);
    summary.checks.push_back(check);
    all = all && result.ok;
  }
  return all;
}

}  // namespace thinwall::app

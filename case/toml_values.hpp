#pragma once
// From the text of a TOML file to values, by the schema that says what it may hold.

#include <string>
#include <vector>

#include "case/problem.hpp"
#include "case/schema/schema.hpp"
#include "case/values.hpp"

namespace thinwall::cases {

/// Values of a file with defaults filled in, and its problems: unknown keys, wrong types, dimensions, bounds.
struct ReadValues {
  CaseValues values;
  std::vector<Problem> problems;
};

/// `added` are keys of tables, "tool.modes[0].stiffness", which are put behind those that their array has in the file,
/// from its number 0 on. `overrides` are "key=value", put over both before they are read. Throws CaseError, which shows
/// `name`, if the text is not TOML; UsageError or InputError for an override that fits no key.
[[nodiscard]] ReadValues read_values(const std::string& text, const std::string& name, const Schema& schema,
                                     const std::vector<std::string>& overrides = {}, const CaseValues& added = {});

}  // namespace thinwall::cases

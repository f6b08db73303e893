#pragma once
// The table of keys as JSON Schema (draft 2020-12), for editors that complete and check TOML by one.

#include <nlohmann/json.hpp>
#include <string>

#include "case/schema/schema.hpp"

namespace thinwall::cases {

/// Tables as objects without further properties, arrays of tables as arrays of these; each key with its meaning, unit,
/// bounds, choices and default. Where a key chooses between alternatives its table has a `oneOf`, a branch for each:
/// the word that chooses it (or the key's absence, where it is the default), the keys that it needs, and none of those
/// that belong to others. What else shows between keys, and the dimension of a unit, it cannot tell: `thinwall check`
/// does.
[[nodiscard]] nlohmann::ordered_json json_schema(const Schema& schema, const std::string& title);

}  // namespace thinwall::cases

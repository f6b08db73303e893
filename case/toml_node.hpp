#pragma once
// One value of a case as a node of a TOML document.

#include <toml++/toml.h>

#include <string>
#include <string_view>

#include "case/schema/schema.hpp"
#include "case/values.hpp"

namespace thinwall::cases {

/// The kind of a node for messages: "a text", "a number", "a table".
[[nodiscard]] std::string_view node_type(const toml::node& node);

/// The value of a node that stands at a key. Throws InputError for another type, a text that is no quantity or has
/// another dimension, and a number outside the key's bounds.
[[nodiscard]] Value read_value(const toml::node& node, const Key& key);

/// The stand-in of a value that could not be read: later checks see that the key is there, and pass over it.
[[nodiscard]] Value unread_value(const Key& key);

/// Puts a value into a table, so that read_value() gives it back to the last bit; not one of a polygon or of positions.
void insert(toml::table& table, const std::string& name, const Key& key, const Value& value);

}  // namespace thinwall::cases

#include "case/schema/json_schema.hpp"

#include <cmath>

namespace thinwall::cases {

namespace {

using Json = nlohmann::ordered_json;

/// A number, perhaps with its unit.
constexpr auto number_pattern = "^\\s*[+-]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][+-]?[0-9]+)?";

Json any_of(const Json& first, const Json& second) {
  return {{"anyOf", Json::array({first, second})}};
}

Json text_schema(const Key& key) {
  const auto allowed = choices(key);
  return allowed.empty() ? Json{{"type", "string"}} : Json{{"enum", allowed}};
}

Json number_schema(const Key& key, const char* type) {
  Json number = {{"type", type}};
  const Bounds& bounds = key.bounds;
  if (std::isfinite(bounds.lower)) number[bounds.lower_open ? "exclusiveMinimum" : "minimum"] = bounds.lower;
  if (std::isfinite(bounds.upper)) number[bounds.upper_open ? "exclusiveMaximum" : "maximum"] = bounds.upper;
  return number;
}

/// A bare number where the kind allows it, or a text with a unit; words that stand in its place.
Json quantity_schema(const Key& key) {
  Json kinds = Json::array();
  if (key.kind.bare_number) kinds.push_back(number_schema(key, "number"));
  kinds.push_back({{"type", "string"}, {"pattern", number_pattern}});
  auto words = choices(key);
  if (key.bounds.infinity_allowed) words.insert(words.end(), {"inf", "infinite"});
  if (!words.empty()) kinds.push_back({{"enum", words}});
  return {{"anyOf", kinds}};
}

Json list_schema(const Json& items, int fewest = 0, int most = 0) {
  Json list = {{"type", "array"}, {"items", items}};
  if (fewest > 0) list["minItems"] = fewest;
  if (most > 0) list["maxItems"] = most;
  return list;
}

Json direction_schema() {
  return any_of({{"type", "string"}, {"pattern", "^[+-]?[xyz]$"}}, list_schema({{"type", "number"}}, 3, 3));
}

Json value_schema(const Key& key) {
  switch (key.type) {
    case Type::text:
    case Type::file:
    case Type::name:
      return {{"type", "string"}};
    case Type::choice:
      return text_schema(key);
    case Type::names:
      return any_of(text_schema(key), list_schema(text_schema(key)));
    case Type::boolean:
      return {{"type", "boolean"}};
    case Type::integer:
      return choices(key).empty() ? number_schema(key, "integer")
                                  : any_of(number_schema(key, "integer"), text_schema(key));
    case Type::quantity:
      return quantity_schema(key);
    case Type::quantities:
      return any_of(quantity_schema(key), list_schema(quantity_schema(key)));
    case Type::vector:
      return list_schema(quantity_schema(key), 3, 3);
    case Type::polygon:
      return list_schema(list_schema(quantity_schema(key), 2, 2), 3);
    case Type::positions:
      return list_schema(list_schema(quantity_schema(key), 3, 3), 2, 200);
    case Type::direction:
      return direction_schema();
    case Type::directions:
      return any_of(direction_schema(), list_schema(direction_schema()));
    case Type::amount:
      return {{"type", Json::array({"number", "string"})}};
  }
  return Json::object();
}

/// The text that an editor shows: the meaning, then unit and bounds in words.
std::string description(const Key& key) {
  std::string text(key.meaning);
  if (!key.kind.unit.empty()) text += " Unit: " + std::string(key.kind.unit) + ".";
  const std::string bounds = bounds_text(key);
  if (!bounds.empty()) text += " Range: " + bounds + ".";
  return text;
}

Json object_schema() {
  return {{"type", "object"}, {"properties", Json::object()}, {"additionalProperties", false}};
}

/// The schema of the table at a path of the table of keys, made where it is not there: "part.holes[]", "points.*".
Json& table_at(Json& root, std::string_view path) {
  Json* table = &root;
  while (!path.empty()) {
    const auto dot = path.find('.');
    std::string name(path.substr(0, dot));
    path = dot == std::string_view::npos ? std::string_view() : path.substr(dot + 1);
    const bool array = name.ends_with("[]");
    if (array) name.resize(name.size() - 2);
    // Names that the user gives are patterns of properties.
    Json& all = name == "*" ? (*table)["patternProperties"] : (*table)["properties"];
    Json& entry = all[name == "*" ? "^[A-Za-z][A-Za-z0-9_]*$" : name];
    if (entry.is_null()) entry = array ? list_schema(object_schema()) : object_schema();
    table = array ? &entry["items"] : &entry;
  }
  return *table;
}

}  // namespace

Json json_schema(const Schema& schema, const std::string& title) {
  Json root = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  root.update(object_schema());
  for (const Section& section : schema.sections) {
    if (!section.path.empty()) table_at(root, section.path)["description"] = section.meaning;
  }
  for (const Key& key : schema.keys) {
    const auto dot = key.path.rfind('.');
    const bool top = dot == std::string_view::npos;
    Json& table = table_at(root, top ? std::string_view() : key.path.substr(0, dot));
    const std::string name(top ? key.path : key.path.substr(dot + 1));
    Json value = value_schema(key);
    value["description"] = description(key);
    if (!key.fallback.empty()) value["default"] = Json::parse(key.fallback);
    table["properties"][name] = std::move(value);
    if (key.required) table["required"].push_back(name);
  }
  return root;
}

}  // namespace thinwall::cases

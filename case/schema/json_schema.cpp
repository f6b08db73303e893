#include "case/schema/json_schema.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace thinwall::cases {

namespace {

using Json = nlohmann::ordered_json;

/// A number, perhaps with its unit.
constexpr auto number_pattern = "^\\s*[+-]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][+-]?[0-9]+)?";

Json any_of(const Json& first, const Json& second) {
  return {{"anyOf", Json::array({first, second})}};
}

/// One of the words that a key takes, or any text; an empty one only where it is the default.
Json text_schema(const Key& key) {
  const auto allowed = choices(key);
  if (!allowed.empty()) return {{"enum", allowed}};
  Json text = {{"type", "string"}};
  if (key.fallback != "\"\"") text["minLength"] = 1;
  return text;
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
      return text_schema(key);
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
      return any_of(quantity_schema(key), list_schema(quantity_schema(key), 1));
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
      return {{"type", Json::array({"number", "string"})}, {"minLength", 1}};
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

/// The table at a path below a branch of alternatives, made where it is not there; nullptr where the branch forbids it.
Json* table_in_branch(Json& branch, std::string_view path) {
  Json* table = &branch;
  while (!path.empty()) {
    const auto dot = path.find('.');
    std::string name(path.substr(0, dot));
    path = dot == std::string_view::npos ? std::string_view() : path.substr(dot + 1);
    const bool array = name.ends_with("[]");
    if (array) name.resize(name.size() - 2);
    Json& entry = (*table)["properties"][name];
    if (entry.is_boolean()) return nullptr;
    table = array ? &entry["items"] : &entry;
  }
  return table;
}

std::string bare(std::string_view name) {
  return std::string(name.substr(0, name.find('[')));
}

/// A pattern that files with these endings match, in capitals or not: ".msh|.inp" as "\\.([mM][sS][hH]|[iI][nN][pP])$".
std::string file_pattern(std::string_view endings) {
  std::string pattern;
  for (const std::string& ending : words_of(endings)) {
    pattern += pattern.empty() ? "\\.(" : "|";
    for (const char letter : ending.substr(1))
      pattern += {'[', letter, static_cast<char>(std::toupper(static_cast<unsigned char>(letter))), ']'};
  }
  return pattern + ")$";
}

/// Any of the keys of a telling; with the ending that it asks for, and none that an earlier one does.
Json told(const Schema& schema, const Telling& telling) {
  Json keys = Json::array(), result;
  for (const std::string& by : words_of(telling.by))
    keys.push_back({{"required", Json::array({std::string(last_name(by))})}});
  result["anyOf"] = keys;
  const std::string name(last_name(telling.by));
  if (!telling.endings.empty()) result["properties"][name] = {{"pattern", file_pattern(telling.endings)}};
  for (const Telling& earlier : schema.tellings) {
    if (&earlier == &telling) break;
    if (earlier.by == telling.by && !earlier.endings.empty())
      result["properties"][name] = {{"not", {{"pattern", file_pattern(earlier.endings)}}}};
  }
  return result;
}

Json requiring(std::string_view path) {
  return {{"required", Json::array({bare(last_name(path))})}};
}

/// The schema of a table whose chooser has one word: it requires the keys that the word needs and forbids those of
/// others.
Json branch(const Schema& schema, const Key& chooser, const std::string& word) {
  const std::string name(last_name(chooser.path));
  Json result = {{"properties", {{name, {{"const", word}}}}}};
  for (const Belonging& belonging : schema.belongings) {
    if (belonging.chooser != chooser.path) continue;
    const auto words = words_of(belonging.words);
    const bool foreign = std::ranges::find(words, word) == words.end();
    if (!foreign && !belonging.needed) continue;
    const std::string_view rest = belonging.path.substr(table_of(chooser.path).size() + 1);
    Json* table = table_in_branch(result, table_of(rest));
    if (table == nullptr) continue;
    if (foreign) {
      (*table)["properties"][bare(last_name(rest))] = false;
    } else if (!belonging.unless.empty()) {
      (*table)["allOf"].push_back({{"anyOf", {requiring(rest), requiring(belonging.unless)}}});
    } else {
      (*table)["required"].push_back(bare(last_name(rest)));
    }
  }
  if (chooser.fallback == "\"" + word + "\"") return result;
  const Json chosen = {{"required", Json::array({name})}};
  const auto tells = [&](const Telling& t) { return t.chooser == chooser.path && t.word == word; };
  const auto telling = std::ranges::find_if(schema.tellings, tells);
  if (telling == schema.tellings.end()) {
    result["required"].push_back(name);
    return result;
  }
  Json silent = told(schema, *telling);
  silent["not"] = chosen;
  result["anyOf"] = Json::array({chosen, silent});
  return result;
}

/// A table in which nothing is chosen: neither the chooser nor what tells its word.
Json nothing_chosen(const Schema& schema, const Key& chooser) {
  Json keys = Json::array();
  keys.push_back({{"required", Json::array({std::string(last_name(chooser.path))})}});
  for (const Telling& telling : schema.tellings) {
    if (telling.chooser != chooser.path) continue;
    for (const std::string& by : words_of(telling.by))
      keys.push_back({{"required", Json::array({std::string(last_name(by))})}});
  }
  return {{"not", {{"anyOf", keys}}}};
}

/// The alternatives of each chooser's table.
void add_alternatives(Json& root, const Schema& schema) {
  for (const Key& chooser : schema.keys) {
    const bool chooses = std::ranges::any_of(
        schema.belongings, [&](const Belonging& belonging) { return belonging.chooser == chooser.path; });
    if (!chooses) continue;
    Json branches = Json::array();
    for (const std::string& word : choices(chooser)) branches.push_back(branch(schema, chooser, word));
    if (chooser.fallback.empty() && !chooser.required) branches.push_back(nothing_chosen(schema, chooser));
    Json& table = table_at(root, table_of(chooser.path));
    if (table.contains("oneOf")) table["allOf"].push_back({{"oneOf", std::move(branches)}});  // a second choice
    else table["oneOf"] = std::move(branches);
  }
}

}  // namespace

Json json_schema(const Schema& schema, const std::string& title) {
  Json root = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  root.update(object_schema());
  for (const Section& section : schema.sections) {
    if (!section.path.empty()) table_at(root, section.path)["description"] = section.meaning;
  }
  for (const Key& key : schema.keys) {
    Json& table = table_at(root, table_of(key.path));
    const std::string name(last_name(key.path));
    Json value = value_schema(key);
    value["description"] = description(key);
    if (!key.fallback.empty()) value["default"] = Json::parse(key.fallback);
    table["properties"][name] = std::move(value);
    if (key.required) table["required"].push_back(name);
  }
  add_alternatives(root, schema);
  return root;
}

}  // namespace thinwall::cases

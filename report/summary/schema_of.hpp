#pragma once
// JSON Schema (draft 2020-12) of sections, from their lists of fields.

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "report/summary/field.hpp"

namespace thinwall::report {

/// The schema of a value of a type.
template <class T>
[[nodiscard]] nlohmann::ordered_json type_schema();

/// Collects the schema of an object from the fields that it visits.
struct SchemaWriter {
  nlohmann::ordered_json properties = nlohmann::ordered_json::object(), required = nlohmann::ordered_json::array();

  template <class T>
  void operator()(const Field& field, const T&) {
    nlohmann::ordered_json value = schema_of<T>(field);
    value["description"] = field.meaning;
    if (field.kind != Kind::section) value["kind"] = core::word_of(field.kind);
    if (!unit_of(field.kind).empty()) value["unit"] = unit_of(field.kind);
    const std::string key(field.key);
    properties[key] = std::move(value);
    const bool there = is_optional<T> ? field.presence == Presence::or_null : field.presence != Presence::if_any;
    if (there) required.push_back(key);
  }

 private:
  /// An optional whose absence is an absent key is not null but where it holds another optional.
  template <class T>
  static nlohmann::ordered_json schema_of(const Field& field) {
    if constexpr (is_optional<T>) {
      if (field.presence == Presence::by_type) return type_schema<typename T::value_type>();
    }
    return type_schema<T>();
  }
};

/// The schema of a section: every key with its type, meaning, kind and unit.
template <class T>
[[nodiscard]] nlohmann::ordered_json object_schema() {
  SchemaWriter writer;
  const T section{};
  fields(writer, section);
  return {{"type", "object"},
          {"properties", std::move(writer.properties)},
          {"required", std::move(writer.required)},
          {"additionalProperties", false}};
}

template <class T>
nlohmann::ordered_json type_schema() {
  if constexpr (is_optional<T>) {
    nlohmann::ordered_json schema = type_schema<typename T::value_type>();
    schema["type"] = nlohmann::ordered_json::array({schema["type"], "null"});
    return schema;
  } else if constexpr (is_list<T>) {
    return {{"type", "array"}, {"items", type_schema<typename T::value_type>()}};
  } else if constexpr (std::same_as<T, Eigen::Vector3d>) {
    return {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 3}, {"maxItems", 3}};
  } else if constexpr (std::same_as<T, std::map<std::string, double>>) {
    return {{"type", "object"}, {"additionalProperties", {{"type", "number"}}}};
  } else if constexpr (IsWord<T>) {
    return {{"type", "string"}, {"enum", core::words<T>}};
  } else if constexpr (IsSection<T>) {
    return object_schema<T>();
  } else {
    return {{"type", std::same_as<T, bool>          ? "boolean"
                     : std::same_as<T, std::string> ? "string"
                     : std::integral<T>             ? "integer"
                                                    : "number"}};
  }
}

/// The schema of a file that is one section.
template <class T>
[[nodiscard]] nlohmann::ordered_json file_schema(const std::string& title) {
  nlohmann::ordered_json root = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", title}};
  root.update(object_schema<T>());
  return root;
}

}  // namespace thinwall::report

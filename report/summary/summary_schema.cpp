#include "report/summary/summary_schema.hpp"

#include <cctype>

namespace thinwall::report {

namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json type_schema();

/// Collects the schema of an object from the fields that it visits.
struct SchemaWriter {
  Json properties = Json::object(), required = Json::array();

  template <class T>
  void operator()(const Field& field, const T&) {
    Json value = schema_of<T>(field);
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
  static Json schema_of(const Field& field) {
    if constexpr (is_optional<T>) {
      if (field.presence == Presence::by_type) return type_schema<typename T::value_type>();
    }
    return type_schema<T>();
  }
};

template <class T>
Json object_schema() {
  SchemaWriter writer;
  const T section{};
  fields(writer, section);
  return {{"type", "object"},
          {"properties", std::move(writer.properties)},
          {"required", std::move(writer.required)},
          {"additionalProperties", false}};
}

template <class T>
Json type_schema() {
  if constexpr (is_optional<T>) {
    Json schema = type_schema<typename T::value_type>();
    schema["type"] = Json::array({schema["type"], "null"});
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

/// Collects the kinds of the values below a path.
struct KindCollector {
  std::map<std::string, Kind>* kinds;
  std::string path;

  template <class T>
  void operator()(const Field& field, const T&) const {
    add<T>((path.empty() ? "" : path + ".") + std::string(field.key), field.kind);
  }

  template <class T>
  void add(const std::string& place, Kind kind) const {
    (*kinds)[place] = kind;
    if constexpr (is_optional<T>) {
      add<typename T::value_type>(place, kind);
    } else if constexpr (is_list<T>) {
      add<typename T::value_type>(place + "[]", kind);
    } else if constexpr (std::same_as<T, Eigen::Vector3d>) {
      (*kinds)[place + "[]"] = kind;
    } else if constexpr (std::same_as<T, std::map<std::string, double>>) {
      (*kinds)[place + ".*"] = kind;
    } else if constexpr (IsSection<T>) {
      const KindCollector below{kinds, place};
      const T section{};
      fields(below, section);
    }
  }
};

/// "lobes[].crossings[].depth_m" of "lobes[0].crossings[12].depth_m".
std::string without_indices(const std::string& path) {
  std::string text;
  bool inside = false;
  for (const char c : path) {
    inside = inside && c != ']';
    if (!inside) text += c;
    inside = inside || c == '[';
  }
  return text;
}

/// The kind at a path; null where the path is not known.
const Kind* known_kind(const std::string& path) {
  const std::string place = without_indices(path);
  auto found = summary_kinds().find(place);
  if (found == summary_kinds().end()) found = summary_kinds().find(place.substr(0, place.rfind('.')) + ".*");
  return found == summary_kinds().end() ? nullptr : &found->second;
}

}  // namespace

Json summary_schema() {
  Json root = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "summary.json of thinwall"}};
  root.update(object_schema<Summary>());
  return root;
}

const std::map<std::string, Kind>& summary_kinds() {
  static const std::map<std::string, Kind> all = [] {
    std::map<std::string, Kind> kinds;
    const KindCollector collect{&kinds, ""};
    const Summary summary{};
    fields(collect, summary);
    return kinds;
  }();
  return all;
}

bool is_known(const std::string& path) {
  return known_kind(path) != nullptr;
}

std::string meaning_at(const std::string& path) {
  static const Json schema = summary_schema();
  const Json* at = &schema;
  std::string key;
  for (const char c : without_indices(path) + ".") {  // "lobes[].minimum_depth_m."
    if (c != '.' && c != '[' && c != ']') {
      key += c;
      continue;
    }
    const Json* below = at;
    if (c == ']') {
      below = at->contains("items") ? &(*at)["items"] : nullptr;
    } else if (!key.empty()) {
      below = at->contains("properties") && (*at)["properties"].contains(key) ? &(*at)["properties"][key] : nullptr;
    }
    if (below == nullptr) return "";
    at = below;
    key.clear();
  }
  return at->value("description", "");
}

Kind kind_at(const std::string& path) {
  const Kind* kind = known_kind(path);
  return kind == nullptr ? Kind::ratio : *kind;
}

}  // namespace thinwall::report

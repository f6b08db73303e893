#include "report/summary/summary_schema.hpp"

#include <cctype>

#include "report/summary/schema_of.hpp"

namespace thinwall::report {

namespace {

using Json = nlohmann::ordered_json;

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
  return file_schema<Summary>("summary.json of thinwall");
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

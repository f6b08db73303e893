#pragma once
// Sections of summary.json as JSON, by their lists of fields.

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "report/summary/field.hpp"

namespace thinwall::report {

template <class T>
[[nodiscard]] nlohmann::json json_of(const T& value);

/// Puts the fields that it visits into a JSON object.
struct JsonWriter {
  nlohmann::json object = nlohmann::json::object();

  template <class T>
  void operator()(const Field& field, const T& value) {
    if constexpr (is_optional<T>) {
      if (!value && field.presence == Presence::by_type) return;
    } else if constexpr (is_list<T>) {
      if (value.empty() && field.presence == Presence::if_any) return;
    }
    object[std::string(field.key)] = json_of(value);
  }
};

/// The value as JSON: of a section the object of its fields, of an empty optional null. JSON has no infinity, so that
/// what is not finite becomes null.
template <class T>
nlohmann::json json_of(const T& value) {
  if constexpr (is_optional<T>) {
    return value ? json_of(*value) : nlohmann::json(nullptr);
  } else if constexpr (is_list<T>) {
    nlohmann::json list = nlohmann::json::array();
    for (const auto& entry : value) list.push_back(json_of(entry));
    return list;
  } else if constexpr (std::same_as<T, Eigen::Vector3d>) {
    return nlohmann::json::array({json_of(value.x()), json_of(value.y()), json_of(value.z())});
  } else if constexpr (IsSection<T>) {
    JsonWriter writer;
    fields(writer, value);
    return std::move(writer.object);
  } else if constexpr (IsWord<T>) {
    return nlohmann::json(core::word_of(value));
  } else if constexpr (std::same_as<T, double>) {
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
  } else {
    return nlohmann::json(value);
  }
}

}  // namespace thinwall::report

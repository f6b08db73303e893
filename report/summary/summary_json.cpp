#include "report/summary/summary_json.hpp"

#include <limits>

#include "io/json_file.hpp"
#include "report/summary/write_json.hpp"

namespace thinwall::report {

namespace {

using io::JsonValue;

/// Null is a number that was not finite (json_of).
void take(const JsonValue& from, double& value) {
  value = from.json->is_null() ? std::numeric_limits<double>::quiet_NaN() : from.number();
}

void take(const JsonValue& from, int& value) {
  value = from.integer(std::numeric_limits<int>::min(), std::numeric_limits<int>::max());
}

void take(const JsonValue& from, long& value) {
  if (!from.json->is_number_integer()) from.refuse("is no whole number");
  value = from.json->get<long>();
}

void take(const JsonValue& from, bool& value) {
  if (!from.json->is_boolean()) from.refuse("is neither true nor false");
  value = from.json->get<bool>();
}

void take(const JsonValue& from, std::string& value) {
  value = from.text();
}

template <IsWord T>
void take(const JsonValue& from, T& value) {
  const std::optional<T> known = core::from_word<T>(from.text());
  if (!known) from.refuse("is none of the words that may stand here");
  value = *known;
}

void take(const JsonValue& from, Eigen::Vector3d& value) {
  const std::vector<double> numbers = from.numbers();
  if (numbers.size() != 3) from.refuse("is no list of three numbers");
  value = Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
}

void take(const JsonValue& from, std::map<std::string, double>& value) {
  if (!from.json->is_object()) from.refuse("is no object");
  for (const auto& [key, number] : from.json->items()) value[key] = from.at(key).number();
}

template <IsSection T>
void take(const JsonValue& from, T& section);
template <class T>
void take(const JsonValue& from, std::vector<T>& list);

/// An optional that is there: null is no value.
template <class T>
void take(const JsonValue& from, std::optional<T>& value) {
  if (from.json->is_null() && !is_optional<T>) return;
  take(from, value.emplace());
}

template <class T>
void take(const JsonValue& from, std::vector<T>& list) {
  for (const JsonValue& entry : from.items()) take(entry, list.emplace_back());
}

/// Takes the fields that it visits out of a JSON object.
struct JsonReader {
  JsonValue object;

  template <class T>
  void operator()(const Field& field, T& value) const {
    const std::string key(field.key);
    const bool may_be_absent = is_optional<T> || field.presence == Presence::if_any;
    if (may_be_absent && object.json->is_object() && !object.json->contains(key)) return;
    take(object.at(key), value);
  }
};

template <IsSection T>
void take(const JsonValue& from, T& section) {
  const JsonReader reader{from};
  fields(reader, section);
}

}  // namespace

nlohmann::json summary_json(const Summary& summary) {
  return json_of(summary);
}

Summary summary_from(const nlohmann::json& document, const std::filesystem::path& file) {
  Summary summary;
  take(JsonValue{&document, file.string(), ""}, summary);
  return summary;
}

}  // namespace thinwall::report

#include "io/json_file.hpp"

#include <nlohmann/json.hpp>

#include "core/atomic_file.hpp"
#include "core/error.hpp"

namespace thinwall::io {

namespace {

using nlohmann::json;

constexpr int deepest_json = 100;  // functions that walk a document call themselves once for each level

[[noreturn]] void refuse_kind(const JsonValue& value, const std::string& expected) {
  value.refuse("is " + kind_of(*value.json) + " where " + expected + " is expected");
}

}  // namespace

json read_json(const std::filesystem::path& file) {
  const std::string text = core::read_file(file);
  const auto bounded = [&](int depth, json::parse_event_t, const json&) {
    if (depth > deepest_json)
      throw core::DataError("\"" + file.string() + "\": lists and objects lie more than " +
                            std::to_string(deepest_json) + " deep in each other; the file is not of thinwall");
    return true;
  };
  try {
    return json::parse(text, bounded);
  } catch (const json::parse_error& error) {
    throw core::DataError(
        "\"" + file.string() + "\": " +
        (error.byte > text.size() ? "ends in the middle" : "no JSON from byte " + std::to_string(error.byte) + " on") +
        "; the file is damaged, make it anew");
  } catch (const json::exception&) {
    throw core::DataError("\"" + file.string() + "\": a number is beyond 1e308; the file is damaged, make it anew");
  }
}

std::string json_text(const json& document) {
  return document.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

void write_json(const std::filesystem::path& file, const json& document) {
  core::write_file_atomically(file, json_text(document));
}

void JsonValue::refuse(const std::string& what) const {
  throw core::DataError("\"" + file + "\": " + (place.empty() ? "the document" : place) + " " + what +
                        "; the file is damaged or not of thinwall, make it anew");
}

bool JsonValue::has(const std::string& key) const {
  if (!json->is_object()) refuse_kind(*this, "an object");
  const auto found = json->find(key);
  return found != json->end() && !found->is_null();
}

JsonValue JsonValue::at(const std::string& key) const {
  if (!json->is_object()) refuse_kind(*this, "an object");
  const auto found = json->find(key);
  const std::string there = place.empty() ? key : place + "." + key;
  if (found == json->end()) JsonValue{json, file, there}.refuse("is missing");
  return {&*found, file, there};
}

std::vector<JsonValue> JsonValue::items() const {
  if (!json->is_array()) refuse_kind(*this, "a list");
  std::vector<JsonValue> list;
  for (std::size_t i = 0; i < json->size(); ++i)
    list.push_back({&(*json)[i], file, place + "[" + std::to_string(i) + "]"});
  return list;
}

std::string JsonValue::text() const {
  if (!json->is_string()) refuse_kind(*this, "a text");
  return json->get<std::string>();
}

std::vector<std::string> JsonValue::texts() const {
  std::vector<std::string> list;
  for (const JsonValue& item : items()) list.push_back(item.text());
  return list;
}

double JsonValue::number() const {
  if (!json->is_number()) refuse_kind(*this, "a number");
  return json->get<double>();
}

std::vector<double> JsonValue::numbers() const {
  std::vector<double> list;
  for (const JsonValue& item : items()) list.push_back(item.number());
  return list;
}

int JsonValue::integer(int lower, int upper) const {
  const double value = number();
  if (!json->is_number_integer() || value < lower || value > upper)
    refuse("is " + json->dump() + " where a whole number from " + std::to_string(lower) + " to " +
           std::to_string(upper) + " is expected");
  return json->get<int>();
}

std::string kind_of(const json& value) {
  constexpr std::size_t named = 3;
  if (value.is_array()) return "a list of " + std::to_string(value.size());
  if (!value.is_object())
    return value.is_null() ? "null" : value.is_string() ? "a text" : value.is_number() ? "a number" : "true or false";
  if (value.empty()) return "an empty object";
  std::string text = "an object with ";
  std::size_t told = 0;
  for (const auto& [key, ignored] : value.items()) {
    if (told == named) return text + " and " + std::to_string(value.size() - named) + " more";
    text += (told++ == 0 ? "" : ", ") + key;
  }
  return text;
}

}  // namespace thinwall::io

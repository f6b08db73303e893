#include "case/alternatives.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace thinwall::cases {

namespace {

std::string join(std::string_view table, std::string_view name) {
  return table.empty() ? std::string(name) : std::string(table) + "." + std::string(name);
}

/// As many names of `path` as `pattern` has: "contacts[0].ball" of "contacts[0].ball.radius" for "contacts[].ball".
std::string beginning(const std::string& path, std::string_view pattern) {
  auto names = std::ranges::count(pattern, '.') + 1;
  if (pattern.empty()) return "";
  std::size_t end = 0;
  for (; names > 0 && end != std::string::npos; --names) end = path.find('.', end == 0 ? 0 : end + 1);
  return path.substr(0, end);
}

/// An array of tables without the index of one: "robot.modes" of "robot.modes[0]".
std::string as_a_whole(const std::string& path, std::string_view pattern) {
  return pattern.ends_with("[]") ? path.substr(0, path.rfind('[')) : path;
}

/// Path of the chooser that decides upon the key at `path`.
std::string chooser_of(const Belonging& belonging, const std::string& path) {
  return join(beginning(path, table_of(belonging.chooser)), last_name(belonging.chooser));
}

bool within(std::string_view path, std::string_view table) {
  return path.starts_with(table) &&
         (path.size() == table.size() || path[table.size()] == '.' || path[table.size()] == '[');
}

bool is_there(const CaseValues& values, const std::string& path) {
  return std::ranges::any_of(values, [&](const CaseValue& value) { return within(value.key, path); });
}

/// The chooser's word, or its default; "" if neither is known.
std::string chosen_word(const Schema& schema, const CaseValues& values, const std::string& chooser,
                        std::string_view pattern) {
  if (const CaseValue* value = find(values, chooser)) {
    const auto* text = std::get_if<std::string>(&value->value);
    return text == nullptr ? "" : *text;
  }
  const std::string_view fallback = find_key(schema, pattern)->fallback;  // in quotes
  return fallback.empty() ? "" : std::string(fallback.substr(1, fallback.size() - 2));
}

bool has_word(const Belonging& belonging, const std::string& word) {
  const auto words = words_of(belonging.words);
  return std::ranges::find(words, word) != words.end();
}

/// "\"hertz\" or \"caster\"".
std::string words_text(const Belonging& belonging) {
  std::string text;
  for (const std::string& word : words_of(belonging.words)) text += (text.empty() ? "\"" : " or \"") + word + "\"";
  return text;
}

bool ends_so(std::string file, std::string_view endings) {
  if (endings.empty()) return true;
  std::ranges::transform(file, file.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto list = words_of(endings);
  return std::ranges::find(list, std::filesystem::path(file).extension().string()) != list.end();
}

/// The meaning of a key or a table, as the schema words it.
std::string_view meaning_of(const Schema& schema, std::string_view pattern) {
  if (const Key* key = find_key(schema, pattern)) return key->meaning;
  return find_section(schema, pattern)->meaning;
}

using Faults = std::vector<std::pair<std::string, std::string>>;

/// Tells that the key at `path` belongs to another alternative than `word`, the one that `chooser` has.
std::string foreign_text(const Belonging& belonging, const std::string& chooser, const std::string& word,
                         const std::string& path) {
  return "belongs to " + chooser + " = " + words_text(belonging) + ", but it is \"" + word + "\"; set " + chooser +
         ", or remove " + std::string(last_name(path));
}

void add_foreign(const Schema& schema, const CaseValues& values, const CaseValue& value, Faults& faults) {
  const std::string pattern = pattern_of(schema, value.key);
  for (const Belonging& belonging : schema.belongings) {
    if (!within(pattern, belonging.path)) continue;
    const std::string path = as_a_whole(beginning(value.key, belonging.path), belonging.path);
    const auto reported = [&](const auto& fault) { return within(path, fault.first); };
    if (std::ranges::any_of(faults, reported)) return;
    const std::string chooser = chooser_of(belonging, value.key);
    const std::string word = chosen_word(schema, values, chooser, belonging.chooser);
    if (word.empty() || has_word(belonging, word)) continue;
    faults.emplace_back(path, foreign_text(belonging, chooser, word, path));
  }
}

void add_missing(const Schema& schema, const CaseValues& values, const CaseValue& chooser, Faults& faults) {
  const auto* word = std::get_if<std::string>(&chooser.value);
  if (word == nullptr || word->empty()) return;
  const std::string pattern = pattern_of(schema, chooser.key);
  for (const Belonging& belonging : schema.belongings) {
    if (!belonging.needed || belonging.chooser != pattern || !has_word(belonging, *word)) continue;
    const std::string_view rest = belonging.path.substr(table_of(pattern).size() + 1);
    const std::string path = as_a_whole(join(table_of(chooser.key), rest), rest);
    const std::string table(table_of(path));
    if (is_there(values, path) || !is_there(values, table)) continue;
    if (!belonging.unless.empty() && is_there(values, join(table, last_name(belonging.unless)))) continue;
    faults.emplace_back(path, "missing; " + chooser.key + " = \"" + *word +
                                  "\" needs it: " + std::string(meaning_of(schema, belonging.path)));
  }
}

}  // namespace

bool fits_alternative(const Schema& schema, const CaseValues& values, const std::string& path) {
  const std::string pattern = pattern_of(schema, path);
  return std::ranges::all_of(schema.belongings, [&](const Belonging& belonging) {
    if (belonging.path != pattern) return true;
    const std::string word = chosen_word(schema, values, chooser_of(belonging, path), belonging.chooser);
    return word.empty() || has_word(belonging, word);
  });
}

std::string told_word(const Schema& schema, const CaseValues& values, std::string_view chooser) {
  for (const Telling& telling : schema.tellings) {
    if (telling.chooser != chooser) continue;
    for (const std::string& by : words_of(telling.by)) {
      if (!is_there(values, by)) continue;
      const CaseValue* value = find(values, by);
      const auto* text = value == nullptr ? nullptr : std::get_if<std::string>(&value->value);
      if (ends_so(text == nullptr ? "" : *text, telling.endings)) return std::string(telling.word);
    }
  }
  return "";
}

Faults faults_of_alternatives(const Schema& schema, const CaseValues& values) {
  Faults faults;
  // Defaults are filled where they belong only: those of another alternative show a table that is written, if empty.
  for (const CaseValue& value : values) add_foreign(schema, values, value, faults);
  for (const CaseValue& value : values) add_missing(schema, values, value, faults);
  return faults;
}

}  // namespace thinwall::cases

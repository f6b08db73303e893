// Keys that belong to one alternative: the reader and the JSON Schema refuse them beside every other one. The cases are
// made from the table of keys itself: for each chooser and each of its words the least table that is complete.

#include "case/alternatives.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "case/reader.hpp"
#include "case/toml_values.hpp"
#include "setup/imported_part.hpp"
#include "tests/case/validator.hpp"
#include "tests/core/temporary_folder.hpp"

namespace thinwall::tests::alternatives_test {

using namespace cases;

namespace {

using Json = nlohmann::ordered_json;

const Schema& schema() {
  return case_schema();
}

/// A number within the key's bounds, with its unit.
std::string number_within(const Key& key) {
  const bool below = std::isfinite(key.bounds.upper), above = std::isfinite(key.bounds.lower);
  const double value = below && above ? 0.5 * (key.bounds.lower + key.bounds.upper)
                       : above        ? key.bounds.lower + 100.0
                                      : 1.0;
  return core::exact_text(value, key.kind);
}

/// A value that the key takes.
Json sample(const Key& key) {
  const Json number = number_within(key);
  const auto allowed = choices(key);
  switch (key.type) {
    case Type::boolean:
      return true;
    case Type::integer:
      return static_cast<int>(std::isfinite(key.bounds.lower) ? key.bounds.lower : 1.0);
    case Type::quantity:
    case Type::quantities:
      return number;
    case Type::vector:
      return Json::array({number, number, number});
    case Type::polygon:
      return Json::array({{number, number}, {number, number}, {number, number}});
    case Type::positions:
      return Json::array({{number, number, number}, {number, number, number}});
    case Type::direction:
    case Type::directions:
      return "x";
    default:
      return allowed.empty() ? "P" : allowed.front();
  }
}

/// The table of a pattern in a document; those that are made get the keys that they always need.
Json& table_of_document(Json& document, std::string_view pattern) {
  if (pattern.empty()) return document;
  Json& parent = table_of_document(document, table_of(pattern));
  std::string name(last_name(pattern));
  const bool array = name.ends_with("[]");
  if (array) name.resize(name.size() - 2);
  Json& entry = parent[name];
  const bool made = entry.is_null();
  if (made) entry = array ? Json::array({Json::object()}) : Json::object();
  Json& table = array ? entry[0] : entry;
  for (const Key& key : schema().keys) {
    if (made && key.required && table_of(key.path) == pattern) table[std::string(last_name(key.path))] = sample(key);
  }
  return table;
}

void add(Json& document, std::string_view pattern) {
  if (const Key* key = find_key(schema(), pattern)) {
    Json& table = table_of_document(document, table_of(pattern));
    table[std::string(last_name(pattern))] = sample(*key);
  } else {
    Json& table = table_of_document(document, pattern);
    const auto inside = [&](const Key& k) { return table_of(k.path) == pattern; };
    if (!table.empty()) return;
    const Key& first = *std::ranges::find_if(schema().keys, inside);
    table[std::string(last_name(first.path))] = sample(first);
  }
}

bool fits(const Belonging& belonging, const std::string& word) {
  const auto words = words_of(belonging.words);
  return std::ranges::find(words, word) != words.end();
}

void choose(Json& document, const Key& chooser, const std::string& word) {
  table_of_document(document, table_of(chooser.path))[std::string(last_name(chooser.path))] = word;
  for (const Belonging& belonging : schema().belongings) {
    if (belonging.chooser == chooser.path && belonging.needed && fits(belonging, word)) add(document, belonging.path);
  }
}

/// The least document with that word.
Json document_with(const Key& chooser, const std::string& word) {
  Json document;
  for (const Belonging& around : schema().belongings) {
    if (chooser.path.starts_with(std::string(around.path) + "."))
      choose(document, *find_key(schema(), around.chooser), words_of(around.words).front());
  }
  choose(document, chooser, word);
  return document;
}

/// TOML on one line.
std::string toml_text(const Json& value) {
  if (!value.is_structured()) return value.dump();
  std::string text;
  for (const auto& [name, entry] : value.items())
    text += (text.empty() ? "" : ", ") + (value.is_object() ? name + " = " : "") + toml_text(entry);
  return value.is_object() ? "{ " + text + " }" : "[" + text + "]";
}

ReadValues read(const Json& document) {
  std::string text;
  for (const auto& [name, value] : document.items()) text += name + " = " + toml_text(value) + "\n";
  return read_values(text, "case.toml", schema());
}

/// The path of a pattern in such a document: each array has one table.
std::string path_of(std::string_view pattern) {
  std::string path(pattern);
  if (path.ends_with("[]")) path.resize(path.size() - 2);
  for (auto at = path.find("[]"); at != std::string::npos; at = path.find("[]", at + 1)) path.insert(at + 1, "0");
  return path;
}

/// Calls `visit` with each chooser and each of its words.
template <typename Visit>
void for_each_alternative(Visit visit) {
  for (const Key& chooser : schema().keys) {
    const auto decides = [&](const Belonging& belonging) { return belonging.chooser == chooser.path; };
    if (std::ranges::none_of(schema().belongings, decides)) continue;
    for (const std::string& word : choices(chooser)) visit(chooser, word);
  }
}

template <typename Visit>
void for_each_belonging(const Key& chooser, Visit visit) {
  for (const Belonging& belonging : schema().belongings) {
    if (belonging.chooser == chooser.path) visit(belonging);
  }
}

void erase(Json& document, std::string_view pattern) {
  std::string name(last_name(pattern));
  if (name.ends_with("[]")) name.resize(name.size() - 2);
  table_of_document(document, table_of(pattern)).erase(name);
}

/// Documents that each break one row of the table.
std::vector<Json> wrong_documents() {
  std::vector<Json> wrong;
  for_each_alternative([&](const Key& chooser, const std::string& word) {
    for_each_belonging(chooser, [&](const Belonging& belonging) {
      wrong.push_back(document_with(chooser, word));
      if (!fits(belonging, word)) {
        add(wrong.back(), belonging.path);
      } else if (belonging.needed) {
        erase(wrong.back(), belonging.path);
      } else {
        wrong.pop_back();
      }
    });
  });
  return wrong;
}

TEST(Alternatives, TheTableNamesKeysOfTheSchemaAndWordsOfTheirChoosers) {
  for (const Belonging& belonging : schema().belongings) {
    EXPECT_TRUE(find_key(schema(), belonging.path) || find_section(schema(), belonging.path)) << belonging.path;
    const Key* chooser = find_key(schema(), belonging.chooser);
    ASSERT_NE(chooser, nullptr) << belonging.chooser;
    EXPECT_TRUE(belonging.path.starts_with(table_of(belonging.chooser))) << belonging.path;
    const auto known = choices(*chooser);
    for (const std::string& word : words_of(belonging.words))
      EXPECT_NE(std::ranges::find(known, word), known.end()) << belonging.path << ": " << word;
    EXPECT_FALSE(find_key(schema(), belonging.path) && find_key(schema(), belonging.path)->required) << belonging.path;
  }
}

TEST(Alternatives, EveryAlternativeIsReadWithItsOwnKeys) {
  for_each_alternative([](const Key& chooser, const std::string& word) {
    const ReadValues values = read(document_with(chooser, word));
    EXPECT_TRUE(values.problems.empty()) << values.problems.front().text;
    for (const auto& [key, text] : faults_of_alternatives(schema(), values.values))
      ADD_FAILURE() << key << ": " << text;
  });
}

TEST(Alternatives, AKeyOfAnotherAlternativeIsRefusedByOneMessageWithPlaceAndRemedy) {
  for_each_alternative([](const Key& chooser, const std::string& word) {
    for_each_belonging(chooser, [&](const Belonging& belonging) {
      if (fits(belonging, word)) return;
      Json document = document_with(chooser, word);
      add(document, belonging.path);
      const auto faults = faults_of_alternatives(schema(), read(document).values);
      ASSERT_EQ(faults.size(), 1U) << belonging.path << " with " << word;
      EXPECT_TRUE(path_of(belonging.path).starts_with(faults[0].first)) << belonging.path << ": " << faults[0].first;
      const std::string choice = path_of(chooser.path);
      const std::string said = faults[0].second;
      EXPECT_TRUE(said.starts_with("belongs to " + choice + " = \"")) << said;
      EXPECT_NE(said.find("but it is \"" + word + "\"; set " + choice + ", or remove "), std::string::npos) << said;
    });
  });
}

TEST(Alternatives, AKeyThatTheAlternativeNeedsIsMissed) {
  for_each_alternative([](const Key& chooser, const std::string& word) {
    for_each_belonging(chooser, [&](const Belonging& belonging) {
      if (!belonging.needed || !fits(belonging, word)) return;
      Json document = document_with(chooser, word);
      erase(document, belonging.path);
      const auto faults = faults_of_alternatives(schema(), read(document).values);
      ASSERT_EQ(faults.size(), 1U) << belonging.path << " with " << word;
      EXPECT_EQ(faults[0].first, path_of(belonging.path));
      EXPECT_TRUE(faults[0].second.starts_with("missing; " + path_of(chooser.path) + " = \"" + word + "\" needs it: "));
    });
  });
}

TEST(Alternatives, DefaultsOfOtherAlternativesAreNotFilled) {
  for_each_alternative([](const Key& chooser, const std::string& word) {
    const ReadValues values = read(document_with(chooser, word));
    for_each_belonging(chooser, [&](const Belonging& belonging) {
      const std::string path = path_of(belonging.path);
      if (fits(belonging, word)) return;
      EXPECT_FALSE(find(values.values, path) || has_table(values.values, path)) << path;
    });
  });
}

TEST(Alternatives, TheShapeOfAPartShowsByItsKeysAndByTheEndingOfItsFile) {
  const auto shape_of = [](const std::string& keys) {
    const ReadValues read = read_values("[part]\n" + keys, "case.toml", schema());
    const CaseValue* shape = find(read.values, "part.shape");
    return shape == nullptr ? "" : std::get<std::string>(shape->value);
  };
  EXPECT_EQ(shape_of("length = \"1 m\"\n"), "box");
  EXPECT_EQ(shape_of("[part.matrices]\nstiffness = \"k.mtx\"\n"), "matrices");
  EXPECT_EQ(shape_of("[part.material]\ndensity = \"7850 kg/m^3\"\n"), "");
  for (const char* ending : {".stl", ".STL", ".off", ".obj", ".ply", ".step", ".stp", ".msh", ".inp", ".INP", ".vtu"}) {
    const auto known = setup::shape_of_file(std::string("a") + ending);
    ASSERT_TRUE(known) << ending;
    EXPECT_EQ(shape_of("file = \"a" + std::string(ending) + "\"\n"), core::word_of(*known)) << ending;
  }
}

TEST(Alternatives, TheJsonSchemaAcceptsAndRefusesTheSame) {
  const TemporaryFolder temporary;
  Json good = Json::array();
  for_each_alternative([&](const Key& chooser, const std::string& word) {
    good.push_back(document_with(chooser, word));
    if (chooser.fallback != "\"" + word + "\"") return;
    good.push_back(good.back());  // the default may be left out
    erase(good.back(), chooser.path);
  });
  for (const char* part : {R"({"length": "1 m", "height": "1 m", "thickness": "1 mm"})", R"({"file": "a.STL"})",
                           R"({"file": "a.Inp"})", R"({"matrices": {"stiffness": "k.mtx"}})", "{}"})
    good.push_back({{"part", Json::parse(part)}});
  Json bad = wrong_documents();
  for (const char* part : {R"({"length": "1 m"})", R"({"file": "a.stl", "length": "1 m"})",
                           R"({"file": "a.inp", "repair": {}})", R"({"file": "a.stl", "mass_unit": "t"})"})
    bad.push_back({{"part", Json::parse(part)}});
  core::write_file_atomically(temporary.path / "good.json", good.dump());
  core::write_file_atomically(temporary.path / "bad.json", bad.dump());
  const Validation validation = validate(temporary.path, {temporary.path / "good.json"}, {temporary.path / "bad.json"});
  if (validation.status == 77 || validation.status == 127) GTEST_SKIP() << "no validator: " << validation.said;
  EXPECT_EQ(validation.status, 0) << validation.said;
}

}  // namespace
}  // namespace thinwall::tests::alternatives_test

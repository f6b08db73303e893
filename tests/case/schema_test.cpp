#include "case/schema/schema.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <sstream>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/synonyms.hpp"
#include "core/units.hpp"

namespace thinwall::tests::schema_test {

using namespace cases;

namespace {

TEST(Schema, EveryKeyIsThereOnceAndLiesInASectionThatIsDescribed) {
  std::set<std::string_view> seen;
  for (const auto& key : case_schema().keys) {
    EXPECT_TRUE(seen.insert(key.path).second) << key.path;
    const auto dot = key.path.rfind('.');
    const auto section = dot == std::string_view::npos ? std::string_view() : key.path.substr(0, dot);
    EXPECT_NE(find_section(case_schema(), section), nullptr) << key.path;
    EXPECT_FALSE(key.meaning.empty()) << key.path;
    EXPECT_FALSE(key.required && !key.fallback.empty()) << key.path;
  }
}

TEST(Schema, PatternsFollowFromConcretePaths) {
  const auto pattern = [](const char* path) { return pattern_of(case_schema(), path); };
  EXPECT_EQ(pattern("points.P.at"), "points.*.at");
  EXPECT_EQ(pattern("points.P.at[2]"), "points.*.at");
  EXPECT_EQ(pattern("contacts[2].part"), "contacts[].part");
  EXPECT_EQ(pattern("updating[0].targets[1].value"), "updating[].targets[].value");
  EXPECT_EQ(pattern("damping.ratios[3]"), "damping.ratios");
  EXPECT_EQ(pattern("selections.foot.plane.normal"), "selections.*.plane.normal");
}

TEST(Schema, TablesInTheMiddleMayBeLeftOutWhereThatIsUnambiguous) {
  EXPECT_EQ(full_path(case_schema(), "part.element_size"), "part.mesh.element_size");
  EXPECT_EQ(full_path(case_schema(), "part.length"), "part.length");
  EXPECT_EQ(full_path(case_schema(), "part.nonsense"), "part.nonsense");
}

TEST(Schema, BoundsAreOpenOrClosedAsSaid) {
  const Key& poisson = *find_key(case_schema(), "part.material.poisson_ratio");
  EXPECT_NO_THROW(require_within_bounds(poisson, 0.0));
  EXPECT_NO_THROW(require_within_bounds(poisson, 0.4999));
  EXPECT_THROW(require_within_bounds(poisson, 0.5), core::InputError);
  EXPECT_THROW(require_within_bounds(poisson, std::numeric_limits<double>::quiet_NaN()), core::InputError);
  EXPECT_EQ(bounds_text(poisson), "at least 0, below 0.5");
}

/// The cells of each key's row of a page.
std::vector<std::vector<std::string>> rows_of(const std::string& page) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("| `")) continue;
    rows.emplace_back();
    for (std::size_t at = 2; at < line.size();) {
      const auto end = line.find(" | ", at);
      rows.back().push_back(line.substr(at, end == std::string::npos ? line.size() - 2 - at : end - at));
      at = end == std::string::npos ? line.size() : end + 3;
    }
  }
  return rows;
}

TEST(Schema, EveryKeyIsDocumentedWithMeaningUnitRangeAndDefault) {
  for (const Schema* schema : {&case_schema(), &expectation_schema(), &joints_schema()}) {
    const auto rows = rows_of(schema_markdown(*schema));
    EXPECT_EQ(rows.size(), schema->keys.size());
    for (const auto& key : schema->keys) {
      const std::string name = "`" + std::string(key.path.substr(key.path.rfind('.') + 1)) + "`";
      const auto belonging = std::ranges::find(schema->belongings, key.path, &Belonging::path);
      const bool alternative = belonging != schema->belongings.end();
      const auto row = std::ranges::find_if(rows, [&](const auto& cells) {
        return cells[0] == name && cells.back() == key.meaning && (!alternative || cells.size() == 6);
      });
      ASSERT_NE(row, rows.end()) << key.path;
      const std::size_t type = row->size() - 4;  // in some sections behind the alternative
      for (const auto& word : words_of(alternative ? belonging->words : ""))
        EXPECT_NE((*row)[1].find("`" + word + "`"), std::string::npos) << key.path;
      EXPECT_TRUE(key.meaning.ends_with('.') || key.meaning.ends_with("…")) << key.path << ": " << key.meaning;
      EXPECT_NE((*row)[type].find(key.kind.unit), std::string::npos) << key.path << ": no unit";
      EXPECT_FALSE((*row)[type + 1].empty()) << key.path << ": no default";
      const bool number = key.type == Type::quantity || key.type == Type::integer || key.type == Type::quantities ||
                          key.type == Type::vector || key.type == Type::polygon || key.type == Type::positions;
      EXPECT_EQ((*row)[type + 2].empty(), !number) << key.path << ": no range";
      for (const auto& choice : choices(key))
        EXPECT_NE((*row)[type].find("`" + choice + "`"), std::string::npos) << key.path;
    }
  }
}

TEST(Schema, NoNumberOfACaseOrOfJointsIsWithoutAnUpperBound) {
  const auto is_number = [](const Key& key) {
    return key.type == Type::quantity || key.type == Type::quantities || key.type == Type::integer ||
           key.type == Type::vector;
  };
  for (const Schema* schema : {&case_schema(), &joints_schema()}) {
    for (const Key& key : schema->keys) {
      if (!is_number(key)) continue;
      EXPECT_THROW(require_within_bounds(key, 1e300), core::InputError) << key.path;
    }
  }
}

// The page is printed from the table; with THINWALL_WRITE_DOCS set the test writes it instead.
TEST(Schema, TheDocumentedKeysAreTheKeysOfTheTable) {
  const std::filesystem::path page = std::filesystem::path(THINWALL_SOURCE_DIR) / "docs" / "case-file.md";
  const std::string begin = "<!-- keys of case.toml, printed from case/schema/schema.cpp -->\n";
  const std::string joints = "<!-- keys of the file of joints, printed from case/schema/schema.cpp -->\n";
  const std::string middle = "<!-- keys of expected.toml, printed from case/schema/schema.cpp -->\n";
  const std::string words = "<!-- synonyms, printed from core/synonyms.cpp -->\n";
  const std::string text = core::read_file(page);
  const auto start = text.find(begin);
  ASSERT_NE(start, std::string::npos);
  const std::string expected =
      text.substr(0, start) + begin + "\n" + schema_markdown(case_schema()) + "## Keys of `robot.joints`\n\n" + joints +
      "\n" + schema_markdown(joints_schema()) + "## Keys of `expected.toml`\n\n" + middle + "\n" +
      schema_markdown(expectation_schema()) +
      "## Words by other names\n\nWho writes one of the words on the left is asked whether the "
      "one on the right is meant.\nLetters of another case (`RPM`, `kt`) and misspelt words are "
      "recognised without a table.\n\n" +
      words + "\n" + core::synonyms_markdown();
  if (std::getenv("THINWALL_WRITE_DOCS") != nullptr) core::write_file_atomically(page, expected);
  EXPECT_EQ(core::read_file(page), expected) << "run test_app with THINWALL_WRITE_DOCS=1";
}

// A synonym whose meaning was renamed would suggest a word that nobody knows.
TEST(Schema, EverySynonymMeansAKeyAWordOrAUnitThatIsKnown) {
  std::set<std::string> keys, words{"receptance", "mobility", "accelerance", "guyan"};
  for (const Key& key : case_schema().keys) {
    keys.insert(std::string(last_name(key.path)));
    for (const std::string& choice : choices(key)) words.insert(choice);
  }
  for (const Section& section : case_schema().sections) {
    const std::string_view path = section.path.substr(0, section.path.find_last_not_of("[]") + 1);
    keys.insert(std::string(path.substr(path.rfind('.') + 1)));
  }
  for (const core::Synonym& row : core::synonyms()) {
    const std::string meant(row.meant);
    if (row.kind == core::WordKind::key) {
      EXPECT_TRUE(keys.contains(meant)) << meant;
    }
    if (row.kind == core::WordKind::word) {
      EXPECT_TRUE(words.contains(meant)) << meant;
    }
    if (row.kind == core::WordKind::unit) {
      EXPECT_NO_THROW((void)core::parse_unit(meant)) << meant;
    }
  }
}

}  // namespace
}  // namespace thinwall::tests::schema_test

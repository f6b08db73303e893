// Where a problem points: the line and the caret beneath it.

#include <gtest/gtest.h>

#include "case/problem.hpp"
#include "case/reader.hpp"
#include "tests/case/case_text.hpp"

namespace thinwall::tests::excerpt_test {

using namespace cases;

namespace {

/// What a case with `overrides` shows beneath its only problem.
std::string shown(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    (void)parse_case(text, ".", "case.toml", overrides);
  } catch (const CaseError& error) {
    EXPECT_EQ(error.problems.size(), 1U) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return excerpt(error.source, error.problems.front());
  }
  return "no problem";
}

TEST(Excerpt, TheCaretStandsUnderTheWholeValue) {
  EXPECT_EQ(shown(with(plate_case(), "length = \"392 mm\"", "length  = \"392 kg\"  # long")),
            "      3 | length  = \"392 kg\"  # long\n"
            "        |           ^~~~~~~~\n");
  EXPECT_EQ(shown(with(plate_case(), "at = [1.0, 0.5, 0.95]\n[", "at = [1.0, 0.5, 9.5]\n[")),
            "     18 | at = [1.0, 0.5, 9.5]\n"
            "        |      ^~~~~~~~~~~~~~~\n");
}

TEST(Excerpt, AnUnknownKeyIsPointedAtAndAMissingOneAtItsTable) {
  EXPECT_EQ(shown(with(plate_case(), "thickness = \"6 mm\"", "thickness = \"6 mm\"\n\t thicknes = \"6 mm\"")),
            "      6 | \t thicknes = \"6 mm\"\n"
            "        | \t ^~~~~~~~\n");
  EXPECT_EQ(shown(with(plate_case(), "diameter = \"16 mm\"\n", "")),
            "     38 | [tool]\n"
            "        | ^~~~~~\n");
}

TEST(Excerpt, ColumnsCountCharactersNotBytes) {
  EXPECT_EQ(shown(with(plate_case(), "title = \"plate\"", "\"größe\" = 3")),
            "      1 | \"größe\" = 3\n"
            "        | ^~~~~~~\n");
}

TEST(Excerpt, WhatIsNoTomlIsShownToo) {
  EXPECT_EQ(shown("[part]\nlength = 6 mm\n"),
            "      2 | length = 6 mm\n"
            "        |            ^~\n");
}

TEST(Excerpt, AnOverridePointsIntoTheOption) {
  EXPECT_EQ(shown(plate_case(), {"part.height=90 mm", "part.length=6 kg"}),
            "  --set | part.length=6 kg\n"
            "        |             ^~~~\n");
  EXPECT_EQ(shown(plate_case(), {"part.lenght=6 mm"}),
            "  --set | part.lenght=6 mm\n"
            "        | ^~~~~~~~~~~\n");
  EXPECT_EQ(shown(plate_case(), {"part.nothing.lenght=6 mm"}),
            "  --set | part.nothing.lenght=6 mm\n"
            "        | ^~~~~~~~~~~~~~~~~~~\n");
}

// A table in an option has lines of its own, which are none of the file.
TEST(Excerpt, ATableInAnOptionIsPointedAtInTheOption) {
  EXPECT_EQ(shown(plate_case(), {"points.Q={at = [1.0, 0.5, 0.95], ofset = 3}"}),
            "  --set | points.Q={at = [1.0, 0.5, 0.95], ofset = 3}\n"
            "        | ^~~~~~~~\n");
  EXPECT_EQ(shown(plate_case(), {"robot.frequency=30 Hz",
                                 "part.material={youngs_modulus = \"210 GPa\", poisson_ratio = 0.3, "
                                 "density = \"7 kg\"}"})
                .substr(0, 24),
            "  --set | part.material=");
  EXPECT_EQ(
      shown(plate_case(), {"tool.modes=[{frequency = \"9 Hz\", damping_ratio = 0.1, stiffness = 1e6}]"}).substr(0, 22),
      "  --set | tool.modes=[");
}

TEST(Excerpt, AnEntryOfAListIsPointedAtWhereItWasGiven) {
  EXPECT_EQ(shown(plate_case(), {"damping.ratios[1]=5 mm"}),
            "  --set | damping.ratios[1]=5 mm\n"
            "        |                   ^~~~\n");
  EXPECT_EQ(shown(plate_case(), {"points.P2.offset[0]=5 kg"}).substr(0, 8), "  --set ");
  EXPECT_EQ(
      shown(with(plate_case(), "ratios = [0.008,", "ratios = [\"8 mm\","), {"damping.ratios[1]=0.005"}).find("--set"),
      std::string::npos)
      << "the file is at fault";
}

TEST(Excerpt, WhatOnlyShowsBetweenKeysPointsAtTheOptionToo) {
  EXPECT_EQ(shown(plate_case(), {"cutting.at=\"Q\""}),
            "  --set | cutting.at=\"Q\"\n"
            "        |            ^~~\n");
  EXPECT_EQ(shown(with(plate_case(), "at = \"P\"", "at = \"Q\"")),
            "     43 | at = \"Q\"\n"
            "        |      ^~~\n");
}

TEST(Excerpt, APlaceThatIsNotThereShowsNothing) {
  const CaseText source{"case.toml", "a = 1\n", {"b=2"}};
  EXPECT_EQ(excerpt(source, {0, 0, "x"}), "");
  EXPECT_EQ(excerpt(source, {7, 1, "x"}), "");
  EXPECT_EQ(excerpt(source, {1, 70, "x"}), "");
  EXPECT_EQ(excerpt(source, {-2, 1, "x"}), "");
}

TEST(Excerpt, LongLinesAreCutAndControlCharactersDoNotReachTheTerminal) {
  const CaseText source{"case.toml", "a = \"\033[31m" + std::string(500, 'x') + "\"\r\n"};
  const std::string text = excerpt(source, {1, 5, "x"});
  EXPECT_EQ(text.find('\033'), std::string::npos);
  EXPECT_EQ(text.size(), 2 * (10 + 160 + 1));
}

}  // namespace
}  // namespace thinwall::tests::excerpt_test

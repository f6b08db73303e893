// Suggestions by meaning go before those by spelling.
#include "core/synonyms.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/nearest_name.hpp"

namespace thinwall::tests::synonyms_test {

using namespace core;

namespace {

TEST(Synonyms, AMeaningGoesBeforeASpelling) {
  const std::vector<std::string> cutting{"at", "radial_depth", "feed_per_tooth", "Ka", "Kt", "mode"};
  EXPECT_EQ(nearest_name("ae", cutting), "radial_depth") << "by spelling it would be \"at\"";
  EXPECT_EQ(nearest_name("fz", cutting), "feed_per_tooth");
  EXPECT_EQ(nearest_name("kt", cutting), "Kt") << "by spelling it would be \"at\", one letter away and first";
  EXPECT_EQ(nearest_name("mod", cutting), "mode");
  EXPECT_EQ(nearest_name("climb", {"down", "up"}), "down");
  EXPECT_EQ(nearest_name("Conventional", {"down", "up"}), "up");
}

TEST(Synonyms, AMeaningThatIsNotAmongTheCandidatesIsNotSuggested) {
  EXPECT_EQ(nearest_name("climb", {"x", "y", "z"}), "");
  EXPECT_EQ(meant_name("fz", {"teeth", "diameter"}), "");
}

TEST(Synonyms, OfDottedNamesTheLastPartIsMeantInItsOwnTableFirst) {
  const std::vector<std::string> keys{"robot.stiffness", "tool.stiffness", "cutting.radial_depth"};
  EXPECT_EQ(nearest_name("tool.k", keys), "tool.stiffness");
  EXPECT_EQ(nearest_name("tool.ae", keys), "cutting.radial_depth");
  EXPECT_EQ(nearest_name("ae", keys), "cutting.radial_depth");
}

TEST(Synonyms, AKnownNameIsItself) {
  EXPECT_EQ(nearest_name("kB", {"KB", "kB"}), "kB");
}

TEST(Synonyms, NoWordMeansItself) {
  for (const Synonym& row : synonyms()) {
    for (const Synonym& other : meanings(row.meant))
      EXPECT_TRUE(other.kind != row.kind || other.meant != row.meant) << row.meant << " means itself";
  }
}

TEST(Synonyms, ThePageHoldsEveryRow) {
  const std::string page = synonyms_markdown();
  for (const Synonym& row : synonyms())
    EXPECT_NE(page.find("`" + std::string(row.meant) + "`"), std::string::npos) << row.meant;
  EXPECT_NE(page.find("| `climb`, `climb_milling`"), std::string::npos);
}

}  // namespace
}  // namespace thinwall::tests::synonyms_test

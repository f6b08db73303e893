// Values that are allowed and probably not meant are asked about; what is only unusual is not.

#include "case/checks/doubts.hpp"

#include <gtest/gtest.h>

#include "case/reader.hpp"
#include "tests/case/case_text.hpp"

namespace thinwall::tests::doubts_test {

using namespace cases;

namespace {

/// Doubts about a plate of these sizes.
std::vector<std::string> doubts(const std::string& sizes, const std::vector<std::string>& overrides = {}) {
  return doubts_about(parse_case("[part]\n" + sizes + R"(
[part.material]
youngs_modulus = "210 GPa"
poisson_ratio = 0.3
density = "7850 kg/m^3"
)",
                                 ".", "case.toml", overrides));
}

const std::string in_mm = "length = \"392 mm\"\nheight = \"100 mm\"\nthickness = \"6 mm\"";

TEST(Doubts, LengthsOfMetresWithoutAUnitAreAskedAbout) {
  EXPECT_TRUE(doubts(in_mm).empty());
  const auto wall = doubts(with(in_mm, "\"6 mm\"", "2"));
  ASSERT_EQ(wall.size(), 1U);
  EXPECT_EQ(wall[0],
            "part.thickness is 2 m: did you mean \"2 mm\"? A number without a unit is in metres; write the unit");
  EXPECT_EQ(doubts(in_mm, {"part.thickness=2"}), wall);
  EXPECT_EQ(doubts("length = 392\nheight = 100\nthickness = 6").size(), 3U);
}

TEST(Doubts, APartThatIsTrulyLargeIsNotAskedAbout) {
  EXPECT_TRUE(doubts("length = 12.5\nheight = 2.4\nthickness = 0.05").empty()) << "in metres, with a thin wall";
  EXPECT_TRUE(doubts("length = \"40 m\"\nheight = \"3 m\"\nthickness = \"2 m\"").empty()) << "with its units";
}

TEST(Doubts, AWallThatIsTheLargestExtentIsAskedAboutWithItsUnitToo) {
  const auto wall = doubts(with(in_mm, "6 mm", "2 m"));
  ASSERT_EQ(wall.size(), 1U);
  EXPECT_NE(wall[0].find("did you mean \"2 mm\"? The part is 392 mm by 100 mm otherwise"), std::string::npos)
      << wall[0];
}

TEST(Doubts, APatchThatIsWiderThanThePartIsAskedAbout) {
  const auto with_patch = [](const std::string& radius) {
    return doubts(in_mm + "\n[points.P]\nat = [1, 0.5, 0.5]\npatch_radius = \"" + radius + "\"");
  };
  ASSERT_EQ(with_patch("3 m").size(), 1U);
  EXPECT_TRUE(with_patch("3 m")[0].starts_with("points.P.patch_radius is 3 m, wider than the part of 392 mm"))
      << with_patch("3 m")[0];
  EXPECT_TRUE(with_patch("3 mm").empty());
}

TEST(Doubts, ARobotsCoefficientOfDampingThatIsAsSmallAsARatioIsAskedAbout) {
  const auto with_robot = [](const std::string& damping) {
    return doubts(in_mm + "\n[robot]\nfrequency = \"25 Hz\"\nstiffness = \"2e6 N/m\"\ndirection = \"x\"\n" + damping +
                  "\n[points.P]\nat = [1, 0.5, 0.5]\n[[contacts]]\npart = \"P\"\ndirections = [\"x\"]");
  };
  // c / (2 k / omega) = 0.02 * 157.1 / 4e6
  ASSERT_EQ(with_robot("damping = 0.02").size(), 1U);
  EXPECT_EQ(with_robot("damping = 0.02")[0],
            "robot.damping is 0.02 N s/m, a damping ratio of 8e-07: did you mean damping_ratio = 0.02?");
  EXPECT_TRUE(with_robot("damping = \"510 N s/m\"").empty()) << "2 %";
  EXPECT_TRUE(with_robot("damping = 0").empty());
  EXPECT_TRUE(with_robot("damping_ratio = 0.02").empty());
}

TEST(Doubts, ARobotThatNothingJoinsToThePartIsAskedAbout) {
  const std::string robot = in_mm + "\n[robot]\nfrequency = \"25 Hz\"\nstiffness = \"2e6 N/m\"\ndamping_ratio = 0.02\n";
  ASSERT_EQ(doubts(robot).size(), 1U);
  EXPECT_TRUE(doubts(robot)[0].starts_with("no [[contacts]] join the robot to the part")) << doubts(robot)[0];
  EXPECT_TRUE(doubts(robot + "[points.P]\nat = [1, 0.5, 0.5]\n[[contacts]]\npart = \"P\"").empty());
  EXPECT_TRUE(doubts(robot + "carries = \"tool\"").empty()) << "it has no contacts";
}

TEST(Doubts, MaterialsOfWhichOneIsAMillionTimesSofterAreAskedAbout) {
  const auto beside = [](const std::string& modulus) {
    return doubts(in_mm + "\n[[part.materials]]\non = \"half\"\nyoungs_modulus = \"" + modulus +
                      "\"\npoisson_ratio = 0.3\ndensity = \"7850 kg/m^3\"\n[selections.half.box]\n" +
                      "min = [0, 0, 0]\nmax = [\"6 mm\", \"200 mm\", \"100 mm\"]",
                  {"part.material.youngs_modulus=2000 GPa"});
  };
  ASSERT_EQ(beside("1 MPa").size(), 1U);
  EXPECT_NE(beside("1 MPa")[0].find("part.material has 2000 GPa and the material of \"half\" 1 MPa, a factor of 2e+06"),
            std::string::npos)
      << beside("1 MPa")[0];
  EXPECT_TRUE(beside("5 MPa").empty()) << "a rubber pad";
}

}  // namespace
}  // namespace thinwall::tests::doubts_test

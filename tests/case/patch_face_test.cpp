// The face on which a point's patch lies, as a case chooses it.

#include <gtest/gtest.h>

#include <string>

#include "case/checks/checks.hpp"
#include "case/reader.hpp"
#include "setup/part_geometry.hpp"
#include "tests/case/case_text.hpp"

namespace thinwall::tests::patch_face_test {

using namespace cases;

namespace {

/// The plate with these lines for its point P on the face x_max, 5 mm below z_max.
std::string plate_with(const std::string& lines) {
  const std::string at = "at = [1.0, 0.5, 0.95]";
  return with(plate_case(), at, at + "\n" + lines);
}

/// The one problem of that plate.
std::string problem_of(const std::string& lines) {
  try {
    (void)parse_case(plate_with(lines), ".");
  } catch (const CaseError& error) {
    EXPECT_EQ(error.problems.size(), 1U) << lines;
    return error.problems.front().text;
  }
  return "none";
}

TEST(PatchFace, CarriesAPatchAndThePointLiesOnIt) {
  const std::string patch = "patch_radius = \"3 mm\"\n";
  EXPECT_NE(problem_of(patch + "face = \"x_mix\"").find("points.P.face: there is no face"), std::string::npos);
  EXPECT_NE(problem_of(patch + "face = \"z_max\"").find("5 mm off the plane of \"z_max\""), std::string::npos);
  EXPECT_NE(problem_of("face = \"x_max\"").find("give points.P.patch_radius"), std::string::npos);
}

TEST(PatchFace, IsTheNamedOneOrFollowsFromTheDirections) {
  const std::string patch = "patch_radius = \"3 mm\"\ndirections = [\"z\", \"x\", \"y\"]\n";
  const auto facing = [&](const std::string& lines) {
    const Case source = parse_case(plate_with(patch + lines), ".");
    return setup::facing(source, setup::point(source, "P"));
  };
  ASSERT_EQ(facing("face = \"x_max\"").size(), 1U);
  EXPECT_EQ(facing("face = \"x_max\"")[0].cwiseAbs(), Eigen::Vector3d::UnitX());
  ASSERT_EQ(facing("").size(), 3U);
  EXPECT_EQ(facing("")[0], Eigen::Vector3d::UnitZ());
}

}  // namespace
}  // namespace thinwall::tests::patch_face_test

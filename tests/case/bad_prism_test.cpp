// A part of an outline with zones, holes and bends that cannot be: where, what, and what to do.

#include <gtest/gtest.h>

#include <string>
#include <variant>

#include "case/reader.hpp"
#include "tests/case/case_text.hpp"
#include "tests/case/problems_of.hpp"

namespace thinwall::tests::bad_prism_test {

using namespace setup;
using namespace cases;

namespace {

/// A plate with a hole, a pocket and a rib, bent.
std::string pocket_case() {
  return R"([part]
shape = "prism"
outline = [["0 mm", "0 mm"], ["100 mm", "0 mm"], ["100 mm", "60 mm"], ["0 mm", "60 mm"]]
thickness = "6 mm"
bend = { radius = "200 mm" }
[[part.holes]]
outline = [["80 mm", "40 mm"], ["90 mm", "40 mm"], ["90 mm", "50 mm"]]
[[part.zones]]
outline = [["10 mm", "10 mm"], ["60 mm", "10 mm"], ["60 mm", "50 mm"], ["10 mm", "50 mm"]]
thickness = "3 mm"
[part.material]
youngs_modulus = "70 GPa"
poisson_ratio = 0.33
density = "2700 kg/m^3"
[[part.supports]]
on = "y_min"
[points.P]
position = ["50 mm", "60 mm", "3 mm"]
)";
}

void expect_pocket_problem(const std::string& from, const std::string& to, const std::string& part) {
  const auto problems = problems_of(with(pocket_case(), from, to));
  ASSERT_FALSE(problems.empty()) << from << " -> " << to;
  EXPECT_NE(problems.front().text.find(part), std::string::npos) << problems.front().text;
  EXPECT_EQ(problems.front().text.find('\n'), std::string::npos);
}

TEST(BadPrism, TheGoodOneHasNoProblemAndIsBoundAsWritten) {
  EXPECT_TRUE(problems_of(pocket_case()).empty());
  const Case c = parse_case(pocket_case(), ".");
  EXPECT_EQ(std::get<PrismShape>(c.part->shape).prism.outline.size(), 4U);
  EXPECT_EQ(std::get<PrismShape>(c.part->shape).prism.holes.at(0).size(), 3U);
  EXPECT_DOUBLE_EQ(std::get<PrismShape>(c.part->shape).prism.zones.at(0).top, 0.003);
  EXPECT_DOUBLE_EQ(bend(*c.part)->radius, 0.2);
  EXPECT_TRUE(bounds(*c.part).max().isApprox(Eigen::Vector3d(0.1, 0.06, 0.006)));
  EXPECT_FALSE(c.part->mesh.element_size.has_value());
  EXPECT_DOUBLE_EQ(c.part->mesh.tolerance, 1e-3);
  EXPECT_FALSE(c.part->mesh.time_budget.has_value());
}

TEST(BadPrism, GeometryThatIsNoPartIsRefusedWithItsPlace) {
  expect_pocket_problem(R"(["100 mm", "60 mm"], ["0 mm", "60 mm"]])", R"(["0 mm", "60 mm"], ["100 mm", "60 mm"]])",
                        "cross");
  expect_pocket_problem(R"(thickness = "6 mm")", R"(thickness = "0 mm")", "above 0");
  expect_pocket_problem(R"(["90 mm", "50 mm"]])", R"(["190 mm", "50 mm"]])", "hole");
  expect_pocket_problem(R"(thickness = "3 mm")", "thickness = \"3 mm\"\nbottom = \"7 mm\"", "falls apart");
  expect_pocket_problem(R"(outline = [["80 mm", "40 mm"], ["90 mm", "40 mm"], ["90 mm", "50 mm"]])",
                        R"(outline = [["80 mm", "40 mm"], ["90 mm", "40 mm"]])", "at least three corners");
  expect_pocket_problem(R"(radius = "200 mm")", R"(radius = "2 mm")", "radius");
  expect_pocket_problem(R"(radius = "200 mm")", R"(radius = "10 mm")", "360");
  expect_pocket_problem(R"(radius = "200 mm")", R"(radius = "200 mm", along = "z")", "thickness");
  expect_pocket_problem(R"(["50 mm", "60 mm", "3 mm"])", R"(["50 mm", "61 mm", "3 mm"])", "outside the part");
}

}  // namespace
}  // namespace thinwall::tests::bad_prism_test

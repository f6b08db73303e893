// The path of a case: its positions, the case at each of them, and what is refused.

#include <gtest/gtest.h>

#include <algorithm>

#include "case/problem.hpp"
#include "case/reader.hpp"
#include "case/writer.hpp"
#include "report/path_report.hpp"
#include "setup/path.hpp"
#include "tests/case/case_text.hpp"

namespace thinwall::tests::path_case_test {

using namespace setup;
using namespace cases;
using namespace study;
using namespace report;

namespace {

/// Along the upper edge of the plate, 392 mm long and clamped at both ends; P lies in the middle.
const std::string straight = R"(from = ["6 mm", "40 mm", "95 mm"]
to = ["6 mm", "352 mm", "95 mm"]
)";
const std::string follows = "support = \"follows\"\n";

std::string path_case(const std::string& path) {
  return plate_case() + "[path]\n" + path;
}

int line_of(const std::string& text, const std::string& words) {
  return 1 +
         static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(text.find(words)), '\n'));
}

/// One problem, which says `part` at the line that begins with `key`.
void expect_problem(const std::string& text, const std::string& part, const std::string& key) {
  try {
    (void)parse_case(text, ".");
    ADD_FAILURE() << "accepted, though " << part;
  } catch (const CaseError& error) {
    ASSERT_EQ(error.problems.size(), 1U) << error.what();
    EXPECT_NE(error.problems[0].text.find(part), std::string::npos) << error.problems[0].text;
    EXPECT_EQ(error.problems[0].line, line_of(text, "\n" + key) + 1) << error.problems[0].text;
  }
}

TEST(PathCase, AStraightPathIsEvenlySpacedAndHeldUnlessTheCaseSaysOtherwise) {
  const Case c = parse_case(path_case(straight), ".");
  ASSERT_TRUE(c.path);
  ASSERT_EQ(c.path->positions.size(), 11U);
  EXPECT_FALSE(c.path->robot_follows);
  for (std::size_t i = 0; i < 11; ++i)
    EXPECT_LT((c.path->positions[i] - Eigen::Vector3d(6e-3, 40e-3 + 31.2e-3 * static_cast<double>(i), 95e-3)).norm(),
              1e-12);
  const Case given =
      parse_case(path_case("points = [[\"6 mm\", \"40 mm\", \"95 mm\"], [0.006, 0.06, 0.09]]\n" + follows), ".");
  ASSERT_EQ(given.path->positions.size(), 2U);
  EXPECT_EQ(given.path->positions[1], Eigen::Vector3d(0.006, 0.06, 0.09));
  EXPECT_TRUE(given.path->robot_follows);
  for (const Case& each : {c, given}) {
    const std::string once = resolved_text(each);
    EXPECT_EQ(resolved_text(parse_case(once, ".")), once);
  }
}

TEST(PathCase, AHeldRobotStaysAtItsPointAndSharesItWhereTheCutPassesThere) {
  const Case c = parse_case(path_case(straight), ".");
  const PathStation at_first = station(c, 0), at_middle = station(c, 5);
  const PartSetup first = part_at(c, at_first), middle = part_at(c, at_middle);
  ASSERT_EQ(first.points.size(), 2U);
  EXPECT_EQ(position(*first.part, point(first, cut_at(c, at_first).cutting->at)), c.path->positions[0]);
  EXPECT_EQ(position(*first.part, point(first, support_at(c, at_first).contacts[0].part_point)),
            position(*c.part, point(c, "P")));
  ASSERT_EQ(middle.points.size(), 1U) << "two points of one place would depend on each other";
  EXPECT_EQ(middle.reduction.interface, std::vector<std::string>{at_middle.cut});
  EXPECT_EQ(support_at(c, at_middle).contacts[0].part_point, at_middle.cut);
}

TEST(PathCase, ARobotThatFollowsKeepsItsDistanceToTheCut) {
  const std::string behind = with(with(path_case(straight + follows), "part = \"P\"", "part = \"P2\""), "[points.P]\n",
                                  "[points.P]\npatch_radius = \"3 mm\"\n");
  const Case c = parse_case(behind, ".");
  for (std::size_t i = 0; i < c.path->positions.size(); ++i) {
    const PathStation at = station(c, i);
    const PartSetup there = part_at(c, at);
    const Point& cut = point(there, at.cut);
    const Point& contact = point(there, at.touched[0]);
    EXPECT_LT((*contact.position - *cut.position - Eigen::Vector3d(0.0, 20e-3, 0.0)).norm(), 1e-12);
    EXPECT_EQ(cut.patch_radius, 3e-3) << "the cut keeps the patch of cutting.at";
    EXPECT_EQ(contact.patch_radius, 0.0);
  }
}

TEST(PathCase, BadPathsAreRefusedWithTheirLine) {
  expect_problem(path_case(straight + "positions = 1\n"), "1 is out of range: it must be at least 2", "positions");
  expect_problem(path_case(straight + "positions = 201\n"), "at most 200", "positions");
  expect_problem(path_case(with(straight, "352 mm", "40 mm")), "positions 1 and 2 are the same", "to = [");
  expect_problem(path_case("points = [[0.006, 0.05, 0.05]]\n"), "list of 2 to 200 positions", "points = [");
  expect_problem(path_case(with(straight, "352 mm", "400 mm")), "position 11 of 11 (6 mm, 400 mm, 95 mm) lies outside",
                 "to = [\"6 mm\", \"400");
  expect_problem(path_case("points = [[0.006, 0.05, 0.05], [0.007, 0.06, 0.05]]\n"),
                 "position 2 of 2 (7 mm, 60 mm, 50 mm) lies", "points = [");
  expect_problem(path_case(with(straight, "40 mm", "0 mm")), "position 1 of 11 is clamped by \"y_min\"",
                 "from = [\"6 mm\"");
  expect_problem(path_case("from = [0.006, 0.05, 0.05]\n"), "add path.to", "from = [0.006");
  expect_problem(path_case(straight + "points = [[0.006, 0.05, 0.05], [0.006, 0.06, 0.05]]\n"), "not both",
                 "from = [\"6 mm\"");
  expect_problem(path_case("support = \"held\"\n"), "give path.from and path.to, or path.points", "support = \"held\"");
  expect_problem(path_case(straight + "support = \"moves\"\n"), "is none of \"held\", \"follows\"",
                 "support = \"moves\"");
}

TEST(PathCase, WhatAPathNeedsIsNamed) {
  const std::string behind =
      with(path_case(with(straight, "352 mm", "380 mm") + follows), "part = \"P\"", "part = \"P2\"");
  expect_problem(behind, "at position 11 of 11 the contact at \"P2\" (6 mm, 400 mm, 95 mm) lies outside", "support");
  const std::string robot =
      "[robot]\nfrequency = \"29 Hz\"\nstiffness = \"1.7e6 N/m\"\ndamping_ratio = 0.02\n[[contacts]]\npart = \"P\"\n";
  expect_problem(with(path_case(straight + follows), robot, ""), "there is no robot to follow the cut", "support");
  expect_problem(with(path_case(straight), "[lobes]\nfrom = \"1000 rpm\"\nto = \"3000 rpm\"\n", ""),
                 "a path needs [tool], [cutting] and [lobes]", "from = [\"6 mm\"");
  const std::string tool_alone = plate_case().substr(plate_case().find("[tool]"));
  expect_problem(with(with(tool_alone, "at = \"P\"\n", ""), "[cutting]",
                      "[[tool.modes]]\nfrequency = \"900 Hz\"\ndamping_ratio = 0.01\nstiffness = \"1e7 "
                      "N/m\"\ndirection = \"x\"\n[cutting]") +
                     "[path]\n" + straight,
                 "there is no modelled part to move along", "from = [\"6 mm\"");
  expect_problem(with(path_case(straight), "[lobes]\n", "[lobes]\nmethod = \"zeroth_order\"\n"),
                 "lobes along a path are by the direct method", "method");
  expect_problem(with(path_case(straight), "[lobes]\n", "[lobes]\nmethod = \"zeroth_ordr\"\n"),
                 "did you mean \"zeroth_order\"", "method");
}

/// Two positions, three speeds; the second position is the weaker one but at the middle speed.
TEST(PathReport, TheWeakestPositionAndTheBestSpeedForAllAreNamed) {
  const Case c = parse_case(path_case("points = [[0.006, 0.05, 0.05], [0.006, 0.06, 0.05]]\n"), ".");
  const auto rows = [](std::vector<double> depths) {
    std::vector<milling::LobeRow> list;
    for (const double depth : depths) {
      list.push_back({});
      list.back().spindle_speed_rpm = 1000.0 * static_cast<double>(list.size());
      list.back().limiting_depth_m = depth;
      list.back().error_estimate = 1e-5;
    }
    return list;
  };
  const PathLobes path{ChartOf::supported,
                       {milling::lobes_of(rows({2e-3, 3e-3, 4e-3}), "direct"),
                        milling::lobes_of(rows({1e-3, 3.5e-3, 2.5e-3}), "direct")}};
  Summary summary;
  summary.path.push_back(path_summary(c, path));
  EXPECT_EQ(summary.path[0].weakest.position, 2);
  EXPECT_EQ(summary.path[0].weakest.at_spindle_speed_rpm, 1000.0);
  EXPECT_EQ(summary.path[0].deepest_everywhere.spindle_speed_rpm, 2000.0);
  EXPECT_EQ(summary.path[0].deepest_everywhere.limited_at_position, 1);
  const std::string text = path_text(summary);
  EXPECT_NE(text.find("weakest at position 2 of 2, (6, 60, 50) mm"), std::string::npos) << text;
  EXPECT_NE(text.find("1.000 mm at 1000 rpm"), std::string::npos) << text;
  EXPECT_NE(text.find("up to 3.000 mm at 2000 rpm, limited at position 1"), std::string::npos) << text;
}

}  // namespace
}  // namespace thinwall::tests::path_case_test

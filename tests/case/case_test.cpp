#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "app/expectation_checks.hpp"
#include "case/machining_case.hpp"
#include "case/numbers.hpp"
#include "case/reader.hpp"
#include "case/writer.hpp"
#include "core/error.hpp"
#include "tests/case/case_text.hpp"

namespace thinwall::tests::case_test {

using namespace app;

using namespace setup;
using namespace cases;

namespace {

TEST(Case, QuantitiesArriveInSi) {
  const Case c = parse_case(plate_case(), ".");
  ASSERT_TRUE(c.part);
  EXPECT_DOUBLE_EQ(std::get<BoxShape>(c.part->shape).length, 0.392);
  EXPECT_DOUBLE_EQ(c.part->material.youngs_modulus, 2.1e11);
  EXPECT_DOUBLE_EQ(c.part->mesh.element_size.value_or(0.0), 0.012);
  EXPECT_EQ(c.part->supports.size(), 2U);
  EXPECT_EQ(c.part->supports[0].fixed, (std::vector<int>{0, 1, 2}));
  EXPECT_DOUBLE_EQ(std::get<ModalDamping>(c.damping).ratios.at(1), 0.006);
  EXPECT_DOUBLE_EQ(*std::get<OneModeRobot>(c.robot->model).frequency_hz, 29.0);
  EXPECT_TRUE(std::isinf(std::get<SpringContact>(c.contacts.at(0).model).stiffness.at(0)));
  EXPECT_EQ(c.contacts[0].directions.at(0), Eigen::Vector3d::UnitX());
  EXPECT_DOUBLE_EQ(c.cutting->Kt, 1.8e9);
  EXPECT_DOUBLE_EQ(*c.cutting->spindle_speed_rpm, 1900.0);
  EXPECT_DOUBLE_EQ(*c.cutting->feed_rate, 0.03);
  EXPECT_DOUBLE_EQ(c.updating.at(0).parameters.at(0).lower, 0.38);
  EXPECT_DOUBLE_EQ(c.updating[0].targets.at(0).value, 212.0);
}

TEST(Case, DefaultsFollowFromTheRestOfTheCase) {
  const Case c = parse_case(plate_case(), ".");
  EXPECT_FALSE(c.part->mesh.order.has_value()) << "2 with a given size";
  EXPECT_EQ(*c.modes.range.count, 10);
  EXPECT_EQ(*c.reduction.fixed_interface.count, 30);
  EXPECT_EQ(c.reduction.interface, (std::vector<std::string>{"P", "P2"}));
  EXPECT_EQ(c.response.points, c.reduction.interface);
  EXPECT_DOUBLE_EQ(c.lobes->depth_limit, 0.020);
  EXPECT_EQ(c.contacts[0].robot_point, "R");
}

TEST(Case, PointsLieWhereFractionsAndOffsetSay) {
  const Case c = parse_case(plate_case(), ".");
  EXPECT_TRUE(box_size(*c.part).isApprox(Eigen::Vector3d(0.006, 0.392, 0.100)));
  EXPECT_TRUE(position(*c.part, point(c, "P")).isApprox(Eigen::Vector3d(0.006, 0.196, 0.095)));
  EXPECT_TRUE(position(*c.part, point(c, "P2")).isApprox(Eigen::Vector3d(0.006, 0.216, 0.095)));
  EXPECT_THROW((void)point(c, "Q"), core::InputError);
}

TEST(Case, SettingAKeyMovesAllThatFollowsFromIt) {
  Case c = parse_case(plate_case(), ".");
  set_value(c, "part.length", 0.4);
  EXPECT_DOUBLE_EQ(std::get<BoxShape>(c.part->shape).length, 0.4);
  EXPECT_DOUBLE_EQ(position(*c.part, point(c, "P")).y(), 0.2);
  set_value(c, "damping.ratios[0]", 0.02);
  EXPECT_DOUBLE_EQ(std::get<ModalDamping>(c.damping).ratios[0], 0.02);
  set_value(c, "robot.stiffness", 2e6);
  EXPECT_DOUBLE_EQ(*std::get<OneModeRobot>(c.robot->model).stiffness, 2e6);
  set_value(c, "tool.length", 0.03);
  EXPECT_DOUBLE_EQ(c.lobes->depth_limit, 0.03);
  set_value(c, "contacts[0].stiffness", 1e8);
  EXPECT_DOUBLE_EQ(std::get<SpringContact>(c.contacts[0].model).stiffness[0], 1e8);
  set_value(c, "points.P.at[2]", 0.9);
  EXPECT_DOUBLE_EQ(point(c, "P").at->z(), 0.9);
  EXPECT_EQ(c.source, plate_case());
}

TEST(Case, EveryNumericKeyReadsBackWhatWasSet) {
  Case c = parse_case(plate_case(), ".");
  for (const auto* key : {"robot.damping_ratio", "part.material.youngs_modulus", "part.element_size", "damping.ratio",
                          "lobes.from", "cutting.Kr", "part.material.poisson_ratio"}) {
    const double value = get_value(c, key);
    set_value(c, key, value == 0.0 ? 1.0 : value * 1.01);
    EXPECT_DOUBLE_EQ(get_value(c, key), value == 0.0 ? 1.0 : value * 1.01) << key;
  }
}

TEST(Case, SettingRefusesWhatTheSchemaRefuses) {
  Case c = parse_case(plate_case(), ".");
  EXPECT_THROW(set_value(c, "part.material.poisson_ratio", 0.5), core::InputError);
  EXPECT_THROW(set_value(c, "part.length", std::numeric_limits<double>::quiet_NaN()), core::InputError);
  EXPECT_THROW(set_value(c, "damping.ratios[2]", 0.01), core::InputError);
  EXPECT_THROW(set_value(c, "robot.mass", 1.0), core::InputError);
  try {
    (void)get_value(c, "part.lenght");
    FAIL() << "no error";
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean \"part.length\"?"), std::string::npos);
  }
  EXPECT_DOUBLE_EQ(std::get<BoxShape>(c.part->shape).length, 0.392);
}

TEST(Case, OverridesGoOverTheFileBeforeValidation) {
  const Case c = parse_case(
      plate_case(), ".", "case.toml",
      {"part.element_size=8 mm", "part.mesh.order=3", "robot.direction=[0, 3, 4]", "contacts[0].directions=[[0, 3, 4]]",
       "modes.count=12", "contacts[0].stiffness=\"1e8 N/m\"", "damping.ratios[1]=0.5 %"});
  EXPECT_DOUBLE_EQ(c.part->mesh.element_size.value_or(0.0), 0.008);
  EXPECT_EQ(c.part->mesh.order, 3);
  EXPECT_TRUE(std::get<OneModeRobot>(c.robot->model).direction.isApprox(Eigen::Vector3d(0, 0.6, 0.8)));
  EXPECT_EQ(*c.modes.range.count, 12);
  EXPECT_DOUBLE_EQ(std::get<SpringContact>(c.contacts[0].model).stiffness[0], 1e8);
  EXPECT_DOUBLE_EQ(std::get<ModalDamping>(c.damping).ratios[1], 0.005);
  EXPECT_THROW((void)parse_case(plate_case(), ".", "case.toml", {"part.length"}), core::UsageError);
  EXPECT_THROW((void)parse_case(plate_case(), ".", "case.toml", {"part.length=6 kg"}), CaseError);
  EXPECT_THROW((void)parse_case(plate_case(), ".", "case.toml", {"contacts[3].stiffness=1"}), core::InputError);
  EXPECT_THROW((void)parse_case(plate_case(), ".", "case.toml", {"part.nonsense=1"}), CaseError);
}

void expect_same(const CaseValues& a, const CaseValues& b) {
  ASSERT_EQ(a.size(), b.size());
  for (const auto& value : a) {
    const CaseValue* other = find(b, value.key);
    ASSERT_NE(other, nullptr) << value.key;
    EXPECT_EQ(other->value, value.value) << value.key;
  }
}

TEST(ResolvedCase, ReadsBackToTheLastBitWithEveryDefaultWritten) {
  auto text = with(plate_case(), "stiffness = \"1.7e6 N/m\"", "stiffness = \"1.7e6 N/m\"\ndirection = [1, 2, 3]");
  text = with(text, "[[contacts]]\npart = \"P\"", "[[contacts]]\npart = \"P\"\ndirections = [[1, 2, 3]]");
  const Case first = parse_case(text, ".");
  const Case second = parse_case(resolved_text(first), ".");
  expect_same(first.values, second.values);
  EXPECT_EQ(resolved_text(second), resolved_text(first));
  for (const auto& value : second.values) EXPECT_TRUE(value.from_file) << value.key << " was left to a default";
}

TEST(ResolvedCase, KeepsSelectionsAndAwkwardTexts) {
  auto text = with(plate_case(), "title = \"plate\"", R"(title = "a \"quoted\" \\ back\u0007slash µ")");
  text = with(text, "on = \"y_min\"", "on = \"foot\"");
  text += "[selections.foot.plane]\npoint = [0, 0, 0]\nnormal = [0, 1, 1e-3]\n";
  const Case first = parse_case(text, ".");
  const Case second = parse_case(resolved_text(first), ".");
  EXPECT_EQ(second.title, first.title);
  expect_same(first.values, second.values);
}

TEST(Expectation, HoldsWithinToleranceAndNeverForWhatIsMissing) {
  const auto summary = nlohmann::json::parse(R"({"coupling": {"modes": [{"frequency_hz": 38.2}]}, "nan": null})");
  const std::string path = "coupling.modes[0].frequency_hz";
  EXPECT_EQ(number_at(summary, path), 38.2);
  EXPECT_FALSE(number_at(summary, "coupling.modes[1].frequency_hz"));
  EXPECT_FALSE(number_at(summary, "coupling.modes[x]"));
  EXPECT_FALSE(number_at(summary, "coupling"));
  Expectation e{"main mode", path, 38.0, {}, 0.01, {}, {}, "published"};
  EXPECT_TRUE(compare(e, summary).ok);
  e.relative = 0.001;
  EXPECT_FALSE(compare(e, summary).ok);
  e.tolerance = 0.2;
  EXPECT_TRUE(compare(e, summary).ok);
  e.at_most = 38.0;
  EXPECT_FALSE(compare(e, summary).ok);
  EXPECT_FALSE(compare({"", "nan", {}, {}, {}, 0.0, {}, ""}, summary).ok);
}

TEST(Expectation, AFigureMayBeComparedWithAnother) {
  const auto summary = nlohmann::json::parse(R"({"ends": [1.0, 1.01]})");
  Expectation e{"", "ends[0]", {}, {}, 0.02, {}, {}, "", "ends[1]"};
  EXPECT_TRUE(compare(e, summary).ok);
  EXPECT_EQ(compare(e, summary).expected.value, 1.01);
  e.relative = 0.005;
  EXPECT_FALSE(compare(e, summary).ok);
  e.same_as = "ends[2]";
  EXPECT_FALSE(compare(e, summary).ok) << "there is no such figure";
}

}  // namespace
}  // namespace thinwall::tests::case_test

// An arm whose joints are calibrated on a few postures, as the mean of what a case learns there.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "case/reader.hpp"
#include "core/error.hpp"
#include "milling/direct/stability.hpp"
#include "setup/identified/identify.hpp"
#include "setup/milling_process.hpp"
#include "setup/robot_tip.hpp"
#include "study/lobes/cut_structure.hpp"
#include "study/postures/posture_study.hpp"
#include "study/support/support_stage.hpp"
#include "tests/case/milling_robot.hpp"

namespace thinwall::cases::arm_mean_test {
namespace {

using tests::milling_robot::FewPostures;
using tests::milling_robot::mean_at;
using tests::milling_robot::test_postures;
using tests::milling_robot::TestPosture;

constexpr std::size_t postures_with_depths = 8;

Case case_at(const FewPostures& postures, const TestPosture& there, const std::string& of_mean) {
  return parse_case(postures.text(there, of_mean), postures.folder.path);
}

/// Limiting depths at all speeds, m.
std::vector<double> depths_of(Case source) {
  setup::identify(source);
  const study::Component tip = study::robot_component(*source.robot, {Eigen::VectorXd::Ones(1)}, {});
  const auto structure = study::cut_poles(source, nullptr, &study::carrier_modes(tip));
  milling::StabilityOptions options;
  options.depth_limit_m = 0.05;
  options.follow = 1.0;
  std::vector<double> depths;
  for (const double rpm : tests::milling_robot::speeds_rpm)
    depths.push_back(
        milling::limiting_depth(*structure, setup::milling_process(source), rpm, options).limiting_depth_m);
  return depths;
}

/// |w/w_true − 1| at all speeds.
std::vector<double> errors_of(const Case& source, const TestPosture& there) {
  std::vector<double> errors = depths_of(source);
  for (std::size_t i = 0; i < errors.size(); ++i) errors[i] = std::abs(1e3 * errors[i] / there.depth_mm[i] - 1.0);
  return errors;
}

double median_error(const FewPostures& postures) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < postures_with_depths; ++i) {
    const TestPosture& there = test_postures()[i];
    const auto here = errors_of(case_at(postures, there, mean_at(there)), there);
    errors.insert(errors.end(), here.begin(), here.end());
  }
  std::ranges::sort(errors);
  return errors[errors.size() / 2];
}

/// With an arm as the mean the median error of the depth is below 7 % from seven postures. All eight test postures are
/// learned for, which takes ten seconds, for a median of fewer would hang on one lobe.
TEST(ArmMean, MakesSevenPosturesDo) {
  EXPECT_LT(median_error(FewPostures(7)), 0.07);
}

/// The answers on learned postures have the arm, too: the depth of all modes at robot.at is that of a chart, which
/// plain processes of seven postures miss. A map needs joints that the columns of robot.over do not tell here.
TEST(ArmMean, IsThatOfTheAnswersOnPostures) {
  const FewPostures postures(7);
  const TestPosture& there = test_postures().front();
  const std::string lobes = "[lobes]\nfrom = \"3000 rpm\"\nto = \"14000 rpm\"\ncount = 2\n";
  const Case source = parse_case(postures.text(there, mean_at(there)) + lobes, postures.folder.path);
  const study::PostureStudy found = study::study_postures(source, study::questions_on({"envelope"}));
  const std::vector<double> depths = depths_of(source), plain = depths_of(case_at(postures, there, ""));
  ASSERT_TRUE(found.envelope);
  EXPECT_NEAR(found.envelope->together(0), depths.front(), 3e-3 * depths.front());
  EXPECT_NEAR(found.envelope->together(1), depths.back(), 3e-3 * depths.back());
  EXPECT_GT(std::abs(plain.front() - depths.front()), 0.02 * depths.front());
  EXPECT_THROW((void)study::study_postures(source, study::questions_on({"map"})), core::InputError);
}

/// A measured tool has no poles beside the robot's, whether it still awaits a fit or not.
TEST(AnswersOnPostures, RefuseAMeasuredTool) {
  Case source = case_at(FewPostures(7), test_postures().front(), "");
  source.tool->measured.emplace_back();
  for (const bool fit : {false, true}) {
    source.tool->fit = fit;
    EXPECT_THROW((void)study::study_postures(source, study::questions_on({"envelope"})), core::InputError) << fit;
  }
}

}  // namespace
}  // namespace thinwall::cases::arm_mean_test

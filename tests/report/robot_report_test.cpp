#include "report/robot_report.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace thinwall::tests::robot_report_test {
namespace {

study::RobotSurvey survey_of(const Eigen::Vector3d& stiffness) {
  study::TipReport tip;
  tip.stiffness = stiffness;
  tip.least_stiffness = 1.7e6;
  study::RobotSurvey survey;
  survey.tips.push_back(tip);
  return survey;
}

// A tip that was measured along x alone is not infinitely stiff along y and z: nothing is known there.
TEST(RobotReport, AnAxisThatWasNotMeasuredIsNamedAndHasNoStiffness) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::string text = report::survey_text(survey_of({1.7e6, infinity, infinity}));
  EXPECT_EQ(text.find("inf"), std::string::npos) << text;
  EXPECT_NE(text.find("     1.7       -       -"), std::string::npos) << text;
  EXPECT_NE(text.find("-: not measured along y, z"), std::string::npos) << text;
  EXPECT_EQ(report::survey_text(survey_of({1.7e6, 2e6, 3e6})).find("not measured"), std::string::npos);
}

}  // namespace
}  // namespace thinwall::tests::robot_report_test

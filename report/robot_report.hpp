#pragma once
// The survey of a robot for people and other programs: a table for the terminal, files, an entry of the summary.

#include <filesystem>
#include <string>

#include "report/summary/robot.hpp"
#include "setup/machining_setup.hpp"
#include "study/support/robot_survey.hpp"

namespace thinwall::report {

/// joints_rad, tip_m, smallest_singular_value of an arm, and preload_n where there is one, for summary.json.
[[nodiscard]] PostureSummary posture_summary(const setup::RobotPosture& robot);

/// A table for the terminal: place, joints, first modes, stiffness.
[[nodiscard]] std::string survey_text(const study::RobotSurvey& survey);

/// robot/postures.csv, out_of_reach.csv where places are, and for an arm postures.vtu (the arm's lines and its tip,
/// with frequencies and stiffnesses), below `folder`. Throws as io::write_csv and io::write_polylines.
void write_survey(const std::filesystem::path& folder, const setup::Setup& source, const study::RobotSurvey& survey);

}  // namespace thinwall::report

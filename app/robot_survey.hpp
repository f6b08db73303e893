#pragma once
// What a robot's tip is like in one posture or in many: modes and stiffness over a workspace or along a path.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/case.hpp"
#include "app/results.hpp"

namespace thinwall::app {

/// The tip in one posture. Stiffnesses are static, N/m: force over displacement along the same direction with the other
/// forces zero, 1/H_nn(0); infinite where the tip does not move. None of a robot known by measured receptances.
struct TipReport {
  RobotPosture robot;
  std::vector<dynamics::ModeSummary> modes;
  std::optional<Eigen::Vector3d> stiffness;           ///< along x, y, z of the part
  std::optional<double> least_stiffness;              ///< over all directions
  Eigen::Vector3d softest = Eigen::Vector3d::Zero();  ///< the direction of that, a unit vector
};

/// A place that the arm does not take, and why.
struct OutOfReach {
  Eigen::Vector3d place;
  std::string reason;
};

struct RobotSurvey {
  std::string over = "posture";  ///< posture, path, workspace
  std::vector<TipReport> tips;
  std::vector<OutOfReach> out_of_reach;
};

/// The tip as the coupling sees it, in that posture.
[[nodiscard]] TipReport tip_report(const RobotPosture& robot, const Component& tip);

/// The robot over its workspace where the case has one, else along its path where the robot follows the cut, else in
/// its one posture. Throws InputError for a case without robot, or if no place at all is reached. Cost O(joints³) a
/// posture.
[[nodiscard]] RobotSurvey survey(const Case& source);

/// joints_rad, tip_m, smallest_singular_value of an arm, and preload_n where there is one, for summary.json.
[[nodiscard]] nlohmann::json posture_summary(const RobotPosture& robot);

/// A table for the terminal: place, joints, first modes, stiffness.
[[nodiscard]] std::string survey_text(const RobotSurvey& survey);

/// robot/postures.csv, out_of_reach.csv where places are, and for an arm postures.vtu (the arm's lines and its tip,
/// with frequencies and stiffnesses), below `folder`. Throws as io::write_csv and io::write_polylines.
void write_survey(const std::filesystem::path& folder, const Case& source, const RobotSurvey& survey);

}  // namespace thinwall::app

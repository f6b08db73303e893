#pragma once
// The robot's tip in one posture or in many: modes and stiffness over a workspace or along a path.

#include <optional>
#include <string>
#include <vector>

#include "setup/machining_setup.hpp"
#include "setup/path.hpp"
#include "study/results.hpp"

namespace thinwall::study {

/// All that a survey reads.
struct SurveyInput {
  setup::PartSetup part;
  setup::SupportSetup support;
  std::vector<setup::PathStation> followed;  ///< stations of a path along which the robot follows the cut; else empty
};

/// The survey's input of a set-up. Errors as setup::stations().
[[nodiscard]] SurveyInput survey_input(const setup::Setup& source);

/// The tip as the coupling sees it, in that posture.
[[nodiscard]] TipReport tip_report(const setup::RobotPosture& robot, const Component& tip);

/// The robot over its workspace where the case has one, else along its path where the robot follows the cut, else in
/// its one posture, whose report is `as_it_stands` where it was made already. A robot that has no joints is the same at
/// every position of a path. No tip at all is an answer, too. Throws InputError for a case without robot. Cost
/// O(joints³) a posture, and the files of a measured robot once.
[[nodiscard]] RobotSurvey survey(const SurveyInput& input, const std::optional<TipReport>& as_it_stands = {});

}  // namespace thinwall::study

#include "setup/identified/learned_modes.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/units.hpp"
#include "posture/bands.hpp"
#include "setup/identified/arm_mean.hpp"
#include "setup/identified/draws.hpp"
#include "setup/identified/posture_tables.hpp"
#include "setup/identified/table_modes.hpp"

namespace thinwall::setup {

namespace {

/// "0.021 to 0.34 %" of a number of all modes, relative.
std::string span(const std::vector<posture::PredictedMode>& modes, Eigen::Index number) {
  const auto [least, largest] = std::ranges::minmax_element(
      modes, {}, [number](const posture::PredictedMode& mode) { return mode.deviation(number); });
  return core::number_text(100.0 * least->deviation(number), 2) + " to " +
         core::number_text(100.0 * largest->deviation(number), 2) + " %";
}

}  // namespace

PostureLearning posture_learning(const TabledRobot& robot, const Eigen::VectorXd& asked_joints) {
  PostureLearning learning{tapped_postures(robot), {}, {scaled_places(robot).at, {}, {}}, {}};
  if (robot.mean)
    learning.options.mean = calibrated_mean(robot, tapped_arm(robot, learned_dofs(robot)), asked_joints,
                                            learning.postures, learning.asked, learning.note);
  return learning;
}

posture::Place place_at(TabledRobot robot, const PostureLearning& learning, const std::vector<double>& at) {
  if (at == robot.postures->at) return learning.asked;
  robot.postures->at = at;
  posture::Place place{scaled_places(robot).at, {}, {}};
  if (!learning.options.mean) return place;
  place.q = joints_from_columns(robot);
  if (place.q.size() == 0)
    throw core::InputError(
        "the joints of the arm are known at the tapped postures and at robot.at alone; name the columns of "
        "robot.joint_columns in robot.over, or ask for no other places");
  if (learning.asked.turn.responses.size() > 0) place.turn = posture::tip_turn(*learning.options.mean, place.q);
  return place;
}

LearnedModes learned_modes(const TabledRobot& robot, const Eigen::VectorXd& asked_joints) {
  if (!robot.postures || !robot.tapped)
    throw core::InputError("\"" + robot.table.string() + "\" was not read; call setup::read_data_files()");
  const dynamics::DofTable dofs = learned_dofs(robot);
  PostureLearning learning = posture_learning(robot, asked_joints);
  const posture::Predictor predictor(std::move(learning.postures), learning.options);
  const posture::PosturePrediction there = predictor.predict(learning.asked);
  LearnedModes result{table_of(posture::expected_modes(there), dofs), {}};
  for (auto& modes : posture::drawn_modes(there, identified_draws))
    result.learned.drawn.push_back(table_of(std::move(modes), dofs));
  result.learned.summary = "the robot's modes are learned from " + std::to_string(robot.tapped->names.size()) +
                           " postures: frequencies within " + span(there.modes, 0) + ", damping ratios within " +
                           span(there.modes, 1) + " (one standard deviation)" + learning.note;
  return result;
}

}  // namespace thinwall::setup

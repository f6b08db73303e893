#include "setup/identified/learned_modes.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/units.hpp"
#include "posture/bands.hpp"
#include "posture/predictor.hpp"
#include "robot/modal_table.hpp"
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

LearnedModes learned_modes(const TabledRobot& robot, const Eigen::VectorXd& asked_joints) {
  if (!robot.postures || !robot.tapped)
    throw core::InputError("\"" + robot.table.string() + "\" was not read; call setup::read_data_files()");
  const ScaledPlaces scaled = scaled_places(robot);
  const dynamics::DofTable dofs = robot::at_point(robot.tapped->tables.front(), robot.table_point).dofs;
  std::vector<posture::TappedPosture> postures = tapped_at_tip(robot);
  posture::Place asked{scaled.at, {}, {}};
  posture::PredictorOptions options;
  std::string of_mean;
  if (robot.mean)
    options.mean = calibrated_mean(robot, tapped_arm(robot, dofs), asked_joints, postures, asked, of_mean);
  const posture::Predictor predictor(std::move(postures), options);
  const posture::PosturePrediction there = predictor.predict(asked);
  LearnedModes result{table_of(posture::expected_modes(there), dofs), {}};
  for (auto& modes : posture::drawn_modes(there, identified_draws))
    result.learned.drawn.push_back(table_of(std::move(modes), dofs));
  result.learned.summary = "the robot's modes are learned from " + std::to_string(robot.tapped->names.size()) +
                           " postures: frequencies within " + span(there.modes, 0) + ", damping ratios within " +
                           span(there.modes, 1) + " (one standard deviation)" + of_mean;
  return result;
}

}  // namespace thinwall::setup

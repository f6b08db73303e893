#include "setup/identified/learned_modes.hpp"

#include <algorithm>
#include <string>

#include "core/error.hpp"
#include "core/units.hpp"
#include "posture/bands.hpp"
#include "posture/predictor.hpp"
#include "robot/modal_table.hpp"
#include "setup/identified/posture_tables.hpp"

namespace thinwall::setup {

namespace {

/// "0.021 to 0.34 %" of a number of all modes, relative.
std::string span(const std::vector<posture::PredictedMode>& modes, Eigen::Index number) {
  const auto [least, largest] = std::ranges::minmax_element(
      modes, {}, [number](const posture::PredictedMode& mode) { return mode.deviation(number); });
  return core::number_text(100.0 * least->deviation(number), 2) + " to " +
         core::number_text(100.0 * largest->deviation(number), 2) + " %";
}

/// The postures as the predictor takes them, with their modes at the tip.
std::vector<posture::TappedPosture> tapped_at_tip(const PostureTables& read, const std::string& tip,
                                                  const Eigen::MatrixXd& places) {
  std::vector<posture::TappedPosture> postures;
  for (std::size_t i = 0; i < read.tables.size(); ++i)
    postures.push_back({{places.row(static_cast<Eigen::Index>(i)).transpose(), {}, {}},
                        modes_of(robot::at_point(read.tables[i], tip), read.files[i].string()),
                        read.labels[i],
                        {}});
  return postures;
}

}  // namespace

LearnedModes learned_modes(const TabledRobot& robot) {
  const PostureTables read = read_posture_tables(robot);
  const ScaledPlaces scaled = scaled_places(read, robot.postures->at);
  const posture::Predictor predictor(tapped_at_tip(read, robot.table_point, scaled.places), {});
  const posture::PosturePrediction there = predictor.predict({scaled.at, {}, {}});
  if (there.modes.empty())
    throw core::InputError("no mode was seen at enough of the " + std::to_string(read.names.size()) + " postures of " +
                           robot.postures->list.string() + " to be learned; tap more");
  const dynamics::DofTable dofs = robot::at_point(read.tables.front(), robot.table_point).dofs;
  LearnedModes result{table_of(posture::expected_modes(there), dofs),
                      {read.files, {}, doubts_about(read, robot.postures->at)}};
  result.learned.summary = "the robot's modes are learned from " + std::to_string(read.names.size()) +
                           " postures: frequencies within " + span(there.modes, 0) + ", damping ratios within " +
                           span(there.modes, 1) + " (one standard deviation), which the error of charts leaves out";
  return result;
}

}  // namespace thinwall::setup

#pragma once
// The files of postures at which a robot was tapped: their list, and a table of modes for each.

#include <string>
#include <vector>

#include "posture/tapped_posture.hpp"
#include "setup/identified/table_modes.hpp"
#include "setup/robot.hpp"

namespace thinwall::setup {

/// Reads the list of `robot.postures` and the table of each, and follows the modes over the postures by the shapes at
/// all points (identification::track()), with an arm as the mean in the tip's frame, too. Throws TabledRobotError: for
/// a robot without postures, a table without
/// "{posture}" in its name, columns and numbers that are not as many, a name of a posture that stands twice, a column
/// that is missing or does not vary, two postures at one place, tables with different DOFs, a mode that moves nothing,
/// modes that were all seen at too few postures, and files that io::read_csv_text() or io::read_modal_table() refuses.
/// Cost: the reading, and the tracking.
[[nodiscard]] PostureTables read_posture_tables(const TabledRobot& robot);

/// The tapped postures' places and the one that is asked for, each column scaled to −1 … 1 over the postures.
struct ScaledPlaces {
  Eigen::MatrixXd places;  ///< a row a posture
  Eigen::VectorXd at;
};

/// The places of a robot whose postures were read.
[[nodiscard]] ScaledPlaces scaled_places(const TabledRobot& robot);

/// The postures of a robot whose postures were read, as a predictor takes them: scaled, with their modes at
/// learned_dofs().
[[nodiscard]] std::vector<posture::TappedPosture> tapped_postures(const TabledRobot& robot);

/// The DOFs whose residues are learned of a robot whose postures were read, table axes (used_part()).
[[nodiscard]] dynamics::DofTable learned_dofs(const TabledRobot& robot);

/// The names of DOFs, in order.
[[nodiscard]] std::vector<std::string> names_of(const dynamics::DofTable& dofs);

/// Sentences on what speaks against modes that are learned of these postures: a posture that is asked for beyond the
/// hull of the tapped ones, modes that were seen at too few, labels that neighbours contradict. Empty of a robot
/// without postures, or whose postures were not read.
[[nodiscard]] std::vector<std::string> doubts_about(const TabledRobot& robot);

/// The robot with the modes of its first posture in place of those that are still to be learned, for checks and
/// forecasts: DOFs and numbers of modes are those of any posture.
[[nodiscard]] TabledRobot as_first_posture(TabledRobot robot);

}  // namespace thinwall::setup

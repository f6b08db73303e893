#pragma once
// The files of postures at which a robot was tapped: their list, and a table of modes for each.

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "dynamics/modal_table.hpp"
#include "setup/identified/table_modes.hpp"
#include "setup/robot.hpp"

namespace thinwall::setup {

/// The content of the files of tapped postures, with the modes of each followed over all of them.
struct PostureTables {
  std::vector<std::string> names;            ///< of the postures
  Eigen::MatrixXd places;                    ///< a row a posture: the columns over which is learned
  std::vector<std::filesystem::path> files;  ///< of the tables
  std::vector<dynamics::ModalTable> tables;
  std::vector<std::vector<int>> labels;  ///< of each posture and mode: modes of one label are one mode of the robot
  int doubtful = 0;                      ///< labels that neighbours contradict
};

/// Reads the list of `robot.postures` and the table of each, and follows the modes over the postures by the shapes at
/// all points (identification::track()). Throws InputError for a robot without postures, a table without "{posture}" in
/// its name, columns and numbers that are not as many, a column that does not vary, tables with different DOFs of the
/// tip; DataError for a column that is missing, a mode that moves nothing, and files as io::read_csv_text() and
/// io::read_modal_table(). Cost: the reading, and the tracking.
[[nodiscard]] PostureTables read_posture_tables(const TabledRobot& robot);

/// The tapped postures' places and the one that is asked for, each column scaled to −1 … 1 over the postures.
struct ScaledPlaces {
  Eigen::MatrixXd places;  ///< a row a posture
  Eigen::VectorXd at;
};

/// The places of postures that were read, and `at` as their columns have it.
[[nodiscard]] ScaledPlaces scaled_places(const PostureTables& read, const std::vector<double>& at);

/// Sentences on what speaks against modes that are learned of these postures: a posture that is asked for beyond the
/// hull of the tapped ones, modes that were seen at too few, labels that neighbours contradict.
[[nodiscard]] std::vector<std::string> doubts_about(const PostureTables& read, const std::vector<double>& at);

}  // namespace thinwall::setup

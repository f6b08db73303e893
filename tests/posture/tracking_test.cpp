// The names of a robot's modes over its postures, against those of its full eigenvectors in small steps.

#include "identification/tracking.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "posture/mode_targets.hpp"

namespace thinwall::posture::tracking_test {
namespace {

using Modes = std::vector<std::vector<identification::FittedMode>>;

/// The numbers of a table of tests/data/milling-robot below its header.
std::vector<std::vector<double>> rows_of(const std::string& name) {
  std::ifstream file(THINWALL_SOURCE_DIR "/tests/data/milling-robot/" + name);
  std::vector<std::vector<double>> rows;
  std::string line, field;
  std::getline(file, line);
  while (std::getline(file, line)) {
    rows.emplace_back();
    for (std::istringstream fields(line); std::getline(fields, field, ',');) rows.back().push_back(std::stod(field));
  }
  return rows;
}

/// Four complex numbers from a column on.
Eigen::VectorXcd vector_of(const std::vector<double>& row, std::size_t column) {
  Eigen::VectorXcd v(4);
  for (std::complex<double>& entry : v) {
    entry = {row[column], row[column + 1]};
    column += 2;
  }
  return v;
}

/// The turn of tip and second point into the frame of a tip that is turned by an angle about the vertical.
Turn turn_by(double angle) {
  const Eigen::Matrix2d of_point{{std::cos(angle), std::sin(angle)}, {-std::sin(angle), std::cos(angle)}};
  Turn turn{Eigen::MatrixXd::Zero(4, 4), {}};
  turn.responses.topLeftCorner(2, 2) = turn.responses.bottomRightCorner(2, 2) = of_point;
  turn.references = turn.responses;
  return turn;
}

/// The grid of 4 x 4 x 7 postures at which the robot was tapped.
struct Grid {
  Eigen::MatrixXd places;
  Modes modes, turned;
  std::vector<std::vector<int>> truth;  ///< from 0 on
};

Grid read_grid() {
  const std::vector<std::vector<double>> postures = rows_of("tapped_postures.csv");
  Grid grid{Eigen::MatrixXd(std::ssize(postures), 3), Modes(postures.size()), Modes(postures.size()), {}};
  grid.truth.resize(postures.size());
  for (std::size_t i = 0; i < postures.size(); ++i)
    grid.places.row(static_cast<Eigen::Index>(i)) << postures[i][1], postures[i][2], postures[i][3];
  for (const std::vector<double>& row : rows_of("tapped_modes.csv")) {
    const auto at = static_cast<std::size_t>(row[0]);
    identification::FittedMode mode;
    mode.frequency_hz = row[1];
    mode.damping_ratio = row[2];
    mode.left = vector_of(row, 4);
    mode.right = vector_of(row, 12);
    mode.residue = mode.right * mode.left.transpose();
    grid.truth[at].push_back(static_cast<int>(row[3]) - 1);
    grid.modes[at].push_back(mode);
    grid.turned[at].push_back(turned(mode, turn_by(postures[at][3] * std::numbers::pi / 180.0)));
  }
  return grid;
}

struct Count {
  int modes = 0, other = 0, other_unsaid = 0, doubtful = 0;
};

/// Names are numbered by mean frequency on both sides, so that equal ones are equal numbers.
Count count(const identification::Tracking& tracking, const std::vector<std::vector<int>>& truth) {
  Count result;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    for (std::size_t k = 0; k < truth[i].size(); ++k) {
      const bool other = tracking.label[i][k] != truth[i][k], doubtful = tracking.doubtful[i][k];
      ++result.modes;
      result.other += other ? 1 : 0;
      result.other_unsaid += other && !doubtful ? 1 : 0;
      result.doubtful += doubtful ? 1 : 0;
    }
  }
  return result;
}

/// At least 99 % of the names are true, as issue 22 asks, and every other one is doubtful, without doubt about more
/// than 3 % of all; by the shapes in the world's axes alone and with those in the tip's.
TEST(TrackedRobot, HasTrueNamesOrDoubtfulOnes) {
  const Grid grid = read_grid();
  for (const Modes& turned : {Modes{}, grid.turned}) {
    const identification::Tracking tracking = identification::track(grid.modes, turned, grid.places);
    const Count found = count(tracking, grid.truth);
    EXPECT_EQ(tracking.labels, 11);
    EXPECT_EQ(found.modes, 1232);
    EXPECT_LE(found.other, 12);
    EXPECT_EQ(found.other_unsaid, 0);
    EXPECT_LE(found.doubtful, 37);
  }
}

}  // namespace
}  // namespace thinwall::posture::tracking_test

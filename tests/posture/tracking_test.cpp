// The names of a robot's modes over its postures, against those of its full eigenvectors in small steps.

#include "identification/tracking.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "posture/learning_curve.hpp"
#include "posture/mode_targets.hpp"
#include "tests/posture/arm_with_truth.hpp"

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

/// The true name with which each name shares most modes.
std::vector<int> true_names(const identification::Tracking& tracking, const std::vector<std::vector<int>>& truth) {
  Eigen::MatrixXi shared = Eigen::MatrixXi::Zero(tracking.labels, 20);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    for (std::size_t k = 0; k < truth[i].size(); ++k) ++shared(tracking.label[i][k], truth[i][k]);
  }
  std::vector<int> names(static_cast<std::size_t>(tracking.labels));
  for (std::size_t l = 0; l < names.size(); ++l) {
    Eigen::Index most = 0;
    shared.row(static_cast<Eigen::Index>(l)).maxCoeff(&most);
    names[l] = static_cast<int>(most);
  }
  return names;
}

/// Names that are not true ones, but for those of `left_out`.
Count count(const identification::Tracking& tracking, const std::vector<std::vector<int>>& truth,
            const std::vector<std::vector<bool>>& left_out = {}) {
  const std::vector<int> name = true_names(tracking, truth);
  Count result;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    for (std::size_t k = 0; k < truth[i].size(); ++k) {
      const bool counts = left_out.empty() || !left_out[i][k];
      const bool other = counts && name[static_cast<std::size_t>(tracking.label[i][k])] != truth[i][k],
                 doubtful = tracking.doubtful[i][k];
      ++result.modes;
      result.other += other ? 1 : 0;
      result.other_unsaid += other && !doubtful ? 1 : 0;
      result.doubtful += doubtful ? 1 : 0;
    }
  }
  return result;
}

/// The modes of some postures of a grid.
Grid part_of(const Grid& grid, const std::vector<std::size_t>& rows) {
  Grid part{grid.places(std::vector<Eigen::Index>(rows.begin(), rows.end()), Eigen::all), {}, {}, {}};
  for (const std::size_t i : rows) {
    part.modes.push_back(grid.modes[i]);
    part.turned.push_back(grid.turned[i]);
    part.truth.push_back(grid.truth[i]);
  }
  return part;
}

/// The mode of a posture with a true name.
const identification::FittedMode& named(const Grid& grid, std::size_t at, int name) {
  return grid.modes[at][static_cast<std::size_t>(std::ranges::find(grid.truth[at], name) - grid.truth[at].begin())];
}

/// The cost of an exchange of two modes of a posture, summed over the six nearest places of the whole grid.
double cost_of_exchange(const Grid& grid, std::size_t at, std::size_t a, std::size_t b) {
  const Eigen::RowVector3d range = grid.places.colwise().maxCoeff() - grid.places.colwise().minCoeff();
  std::vector<std::pair<double, std::size_t>> nearest;
  for (std::size_t i = 0; i < grid.modes.size(); ++i) {
    const auto apart = grid.places.row(static_cast<Eigen::Index>(i)) - grid.places.row(static_cast<Eigen::Index>(at));
    nearest.emplace_back(apart.cwiseQuotient(range).norm(), i);
  }
  std::ranges::sort(nearest);
  double cost = 0.0;
  for (std::size_t k = 1; k <= 6; ++k) {
    const auto& of_a = named(grid, nearest[k].second, grid.truth[at][a]);
    const auto& of_b = named(grid, nearest[k].second, grid.truth[at][b]);
    const identification::FittedMode &mine_a = grid.modes[at][a], &mine_b = grid.modes[at][b];
    cost += identification::unlikeness(of_a, mine_b) + identification::unlikeness(of_b, mine_a) -
            identification::unlikeness(of_a, mine_a) - identification::unlikeness(of_b, mine_b);
  }
  return cost;
}

/// Modes of the low band whose names by small steps jump: exchanged they would agree better with the places around
/// them. Around an exceptional point names have to jump somewhere.
std::vector<std::vector<bool>> jumps(const Grid& grid) {
  constexpr std::size_t low_modes = 7;
  std::vector<std::vector<bool>> result;
  for (std::size_t i = 0; i < grid.modes.size(); ++i) {
    result.emplace_back(grid.modes[i].size(), false);
    for (std::size_t a = 0; a < low_modes; ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        if (cost_of_exchange(grid, i, a, b) < 0.0) result[i][a] = result[i][b] = true;
      }
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

/// Names over 28, 42 and 56 postures of a design that fills the workspace are true or doubtful, or those of small steps
/// jump, which they do at two postures of 112; 3 % are doubtful at most. Neither have these twelve sets by chance other
/// names that nothing is said of; two had some while postures heard others that did not hear them. (Of 600 sets 2 %
/// have some.)
TEST(TrackedRobot, HasTrueNamesOrDoubtfulOnesOfFewPostures) {
  const Grid grid = read_grid();
  const std::vector<std::vector<bool>> jump = jumps(grid);
  std::size_t jumping = 0;
  for (const std::vector<bool>& of : jump) jumping += static_cast<std::size_t>(std::ranges::count(of, true));
  EXPECT_LE(jumping, 4u);
  std::vector<std::vector<std::size_t>> sets;
  std::vector<std::size_t> order = spread_order(grid.places);
  for (const std::ptrdiff_t count : {28, 42, 56}) sets.emplace_back(order.begin(), order.begin() + count);
  const std::size_t designs = sets.size();
  for (const unsigned seed : {3U, 4U, 150U}) {
    std::mt19937 random(seed);
    order = spread_order(grid.places);
    for (const std::ptrdiff_t count : {28, 35, 42, 56}) {
      for (std::size_t i = order.size() - 1; i > 0; --i) std::swap(order[i], order[random() % (i + 1)]);
      sets.emplace_back(order.begin(), order.begin() + count);
    }
  }
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const Grid part = part_of(grid, sets[s]);
    std::vector<std::vector<bool>> left_out;
    for (const std::size_t i : sets[s]) left_out.push_back(jump[i]);
    for (const Modes& turned : {Modes{}, part.turned}) {
      const identification::Tracking tracking = identification::track(part.modes, turned, part.places);
      const Count found = count(tracking, part.truth, left_out);
      EXPECT_EQ(tracking.labels, 11) << s;
      EXPECT_EQ(found.other_unsaid, 0) << s;
      if (s < designs && !turned.empty()) {
        EXPECT_LE(found.doubtful, 0.03 * found.modes) << s;
      }
    }
  }
}

/// Another robot, an elbow arm, whose full shapes were followed from the middle of its workspace.
TEST(TrackedRobot, HasTrueNamesOfAnotherArm) {
  const TappedArm arm = testing::true_arm();
  for (const int count_of_postures : {28, 56}) {
    Grid grid{Eigen::MatrixXd(count_of_postures, 3), {}, {}, {}};
    for (const TappedPosture& posture : testing::tapped_postures(arm, testing::spread_places(count_of_postures, 5))) {
      grid.places.row(std::ssize(grid.modes)) = posture.place.at.transpose();
      grid.modes.push_back(posture.modes);
      grid.truth.push_back(posture.label);
    }
    const identification::Tracking tracking = identification::track(grid.modes, {}, grid.places);
    const Count found = count(tracking, grid.truth);
    EXPECT_EQ(tracking.labels, 5);
    EXPECT_EQ(found.modes, 5 * count_of_postures);
    EXPECT_EQ(found.other_unsaid, 0);
    EXPECT_LE(found.doubtful, 0.03 * found.modes);
  }
}

}  // namespace
}  // namespace thinwall::posture::tracking_test

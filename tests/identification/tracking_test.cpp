// Modes that cross, vanish and appear over postures.

#include "identification/tracking.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <vector>

#include "core/error.hpp"
#include "identification/assignment.hpp"
#include "tests/identification/random_structure.hpp"

namespace thinwall::identification::tracking_test {
namespace {

/// Against all permutations of up to six pairs.
TEST(CheapestPairing, IsTheCheapestOfAll) {
  testing::Draw draw(2);
  for (int trial = 0; trial < 60; ++trial) {
    const int rows = 1 + trial % 6, columns = 1 + (trial / 6) % 6;
    Eigen::MatrixXd cost(rows, columns);
    for (double& c : cost.reshaped()) c = draw.between(-1.0, 1.0);
    const std::vector<int> pair = cheapest_pairing(cost);
    double sum = 0.0;
    int pairs = 0;
    std::vector<bool> taken(static_cast<std::size_t>(columns), false);
    for (int i = 0; i < rows; ++i) {
      const int j = pair[static_cast<std::size_t>(i)];
      if (j < 0) continue;
      ASSERT_FALSE(taken[static_cast<std::size_t>(j)]);
      taken[static_cast<std::size_t>(j)] = true;
      sum += cost(i, j);
      ++pairs;
    }
    ASSERT_EQ(pairs, std::min(rows, columns));
    const Eigen::MatrixXd flat = rows <= columns ? cost : Eigen::MatrixXd(cost.transpose());
    std::vector<int> order(static_cast<std::size_t>(flat.cols()));
    std::iota(order.begin(), order.end(), 0);
    double least = 1e9;
    do {
      double of_order = 0.0;
      for (Eigen::Index i = 0; i < flat.rows(); ++i) of_order += flat(i, order[static_cast<std::size_t>(i)]);
      least = std::min(least, of_order);
    } while (std::next_permutation(order.begin(), order.end()));
    EXPECT_NEAR(sum, least, 1e-12);
  }
}

/// A mode along a direction that turns slowly, with a frequency that rises or falls over the postures.
FittedMode mode(double hz, double angle) {
  FittedMode m;
  m.frequency_hz = hz;
  m.damping_ratio = 0.02;
  m.left = Eigen::Vector2cd(std::cos(angle), std::sin(angle));
  m.right = m.left * std::complex<double>(0.0, -1.0);
  return m;
}

/// 9 × 9 postures: two modes cross along the first direction, a third is not seen in a corner.
std::vector<std::vector<FittedMode>> crossing_postures() {
  std::vector<std::vector<FittedMode>> postures;
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < 9; ++j) {
      const double x = 0.25 * i - 1.0, y = 0.25 * j - 1.0, turn = 0.3 * y;
      std::vector<FittedMode> modes{mode(50.0 * (1.0 + 0.1 * x), turn),
                                    mode(50.0 * (1.0 - 0.1 * x + 0.02 * y), turn + 1.4)};
      if (i > 2 || j > 2) modes.push_back(mode(90.0 + 5.0 * y, 0.7));
      std::ranges::sort(modes, {}, &FittedMode::frequency_hz);
      postures.push_back(modes);
    }
  }
  return postures;
}

TEST(Tracking, FollowsModesThroughCrossingsAndGaps) {
  const std::vector<std::vector<FittedMode>> postures = crossing_postures();
  const Tracking tracking = track(postures);
  EXPECT_EQ(tracking.labels, 3);
  int first_at_middle = -1;
  for (std::size_t i = 0; i < postures.size(); ++i) {
    const double turn = 0.3 * (0.25 * static_cast<double>(i % 9) - 1.0);
    for (std::size_t k = 0; k < postures[i].size(); ++k) {
      const FittedMode& m = postures[i][k];
      const bool third = m.frequency_hz > 80.0;
      const bool first = !third && std::abs(std::abs(m.left(0).real()) - std::cos(turn)) < 1e-9;
      if (first && first_at_middle < 0) first_at_middle = tracking.label[i][k];
      EXPECT_EQ(third, tracking.label[i][k] == 2) << i;
      EXPECT_EQ(first, tracking.label[i][k] == first_at_middle) << i;
      EXPECT_FALSE(tracking.doubtful[i][k]);
    }
  }
}

/// Two modes of a spindle, along and across its tip's direction, at two postures at which the
/// tip stands crosswise: in the world's axes each looks like the other one; in the tip's frame it is itself.
TEST(Tracking, FollowsModesThatTurnWithTheTip) {
  const double quarter = 1.5;
  const auto seen = [](double turn) { return std::vector<FittedMode>{mode(800.0, turn), mode(806.0, turn + 1.57)}; };
  const std::vector<std::vector<FittedMode>> world{seen(0.0), seen(quarter)}, tip{seen(0.0), seen(0.0)};
  const Tracking plain = track(world), framed = track(world, tip);
  EXPECT_NE(plain.label[0], plain.label[1]);
  EXPECT_EQ(framed.label[0], framed.label[1]);
  EXPECT_THROW((void)track(world, {seen(0.0)}), core::InputError);
}

/// The modes of the complex symmetric matrix [x + i, y; y, −x − i], whose eigenvalues ±√((x + i)² + y²) are one at
/// x = 0, y = 1.
std::vector<FittedMode> modes_near_exceptional_point(double x, double y) {
  const std::complex<double> a(x, 1.0), root = std::sqrt(a * a + y * y);
  std::vector<FittedMode> modes;
  for (const std::complex<double> eigenvalue : {root, -root}) {
    FittedMode m = mode(50.0 * (1.0 + 0.1 * eigenvalue.real()), 0.0);
    m.damping_ratio = 0.02 * std::exp(0.1 * eigenvalue.imag());
    m.left = m.right = Eigen::Vector2cd(y, eigenvalue - a).normalized();
    modes.push_back(m);
  }
  std::ranges::sort(modes, {}, &FittedMode::frequency_hz);
  return modes;
}

/// Postures around the exceptional point, of which the ring passes closely below. Once around, the modes have each
/// other's names. Where they differ most, below, the names break along the tree of least difference, and where the
/// postures lie farthest apart, above, along the places: on one side of the ring they depend on the way.
TEST(Tracking, DoubtsNamesThatDependOnTheWay) {
  std::vector<std::vector<FittedMode>> postures;
  Eigen::MatrixXd places(23, 2);
  for (int k = 0, i = 0; k < 24; ++k) {
    if (k == 5) continue;  // the gap, above
    const double angle = (k + 0.5) * std::numbers::pi / 12.0;
    places.row(i) << 0.5 * std::cos(angle), 1.4 + 0.5 * std::sin(angle);
    postures.push_back(modes_near_exceptional_point(places(i, 0), places(i, 1)));
    ++i;
  }
  const Tracking without = track(postures), with = track(postures, {}, places);
  EXPECT_EQ(with.label, without.label);
  for (std::size_t i = 0; i < postures.size(); ++i) {
    const bool right = places(static_cast<Eigen::Index>(i), 0) > 0.0;
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_FALSE(without.doubtful[i][k]) << i;
      EXPECT_EQ(with.doubtful[i][k], right) << i;
    }
  }
  EXPECT_THROW((void)track(postures, {}, places.topRows(3)), core::InputError);
}

TEST(Tracking, RefusesModesWithoutVectors) {
  EXPECT_THROW((void)track({}), core::InputError);
  std::vector<std::vector<FittedMode>> postures = crossing_postures();
  postures[3][0].left.resize(0);
  EXPECT_THROW((void)track(postures), core::InputError);
}

}  // namespace
}  // namespace thinwall::identification::tracking_test

// Cuts until the middle of the posterior of the best speed is, and stays, near that of the true machine: chosen one by
// one, and on a regular grid. Who makes the cuts does not know the truth, so a middle that is right by luck counts.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include "core/draws.hpp"
#include "core/median.hpp"
#include "core/parallel.hpp"
#include "learning/next_cut.hpp"
#include "milling/chart/lobes.hpp"
#include "milling/observed/multiplier_slope.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::learning::best_speed_test {
namespace {

using Eigen::Index;

constexpr double noise = 0.1;
constexpr double from_rpm = 8000.0, to_rpm = 15000.0, deepest_m = 10e-3;

/// A number of machines, and all that is asked of them: chatter at every point of a fine grid, and the best speed.
struct Machines {
  Eigen::MatrixXd chatter;  ///< machines × points
  Eigen::VectorXd log_best;
};

/// The fineness of the study.
struct Study {
  int machines = 200;  ///< draws of what is known beforehand
  int speeds = 40;     ///< among which the best one is looked for
  int grid = 10;       ///< points of the chart in each direction
};

milling::Cut nominal_cut() {
  milling::Cut cut;
  cut.structure = milling::relative_structure(
      milling::testing::modal_model({{780.0, 0.03, 0.27, Eigen::Vector3d(1.0, 0.5, 0.0).normalized()}}), "P");
  cut.process.cutter.teeth = 2;
  cut.process.cutter.diameter_m = 0.016;
  cut.process.coefficients = {1.1e9, 2e8};
  cut.process.engagement = milling::engagement_of(cut.process.cutter, 0.008, milling::MillingDirection::down);
  return cut;
}

/// Points in the middles of count × count fields of the chart.
std::vector<milling::OperatingPoint> grid_of(int count) {
  std::vector<milling::OperatingPoint> points;
  for (int i = 0; i < count; ++i)
    for (int k = 0; k < count; ++k)
      points.push_back({from_rpm + (to_rpm - from_rpm) * (i + 0.5) / count, deepest_m * (k + 0.5) / count});
  return points;
}

Machines drawn_machines(int count, unsigned seed, const std::vector<milling::OperatingPoint>& points, int speeds) {
  const milling::Cut nominal = nominal_cut();
  const auto parameters = milling::uncertain_parameters(nominal, {0.1, 0.2, 0.1, 0.15});
  milling::StabilityOptions options;
  options.depth_limit_m = 2.0 * deepest_m;
  options.error_tolerance = 1e-2;
  std::mt19937 random(seed);
  std::vector<milling::Cut> cuts;
  for (int i = 0; i < count; ++i)
    cuts.push_back(milling::cut_at(nominal, parameters, milling::standard_normal(std::ssize(parameters), random)));
  Machines all{Eigen::MatrixXd(count, std::ssize(points)), Eigen::VectorXd(count)};
  const std::vector<double> rpm = milling::spindle_speeds(from_rpm, to_rpm, speeds);
  core::parallel_for(cuts.size(), [&](std::size_t m) {
    std::vector<std::optional<double>> limits;
    for (const double speed : rpm) limits.push_back(limit_at(cuts[m], speed, options));
    all.log_best(static_cast<Index>(m)) = std::log(best_speed_rpm(rpm, limits).value());
    for (std::size_t p = 0; p < points.size(); ++p) {
      const auto mu =
          milling::multiplier_slope(cuts[m], {}, Eigen::VectorXd(), points[p], nominal.structure.poles, false);
      all.chatter(static_cast<Index>(m), static_cast<Index>(p)) = chatter_probability(mu.margin, noise);
    }
  });
  return all;
}

/// The draws of what is known beforehand, weighed by the cuts that were made on one machine.
struct Belief {
  const Machines& draws;
  Eigen::VectorXd weights;

  explicit Belief(const Machines& of)
      : draws(of),
        weights(Eigen::VectorXd::Constant(of.log_best.size(), 1.0 / static_cast<double>(of.log_best.size()))) {}

  void learn(Index point, bool chatters) {
    const Eigen::VectorXd p = draws.chatter.col(point);
    weights = weights.cwiseProduct(chatters ? p : Eigen::VectorXd(Eigen::VectorXd::Ones(p.size()) - p));
    weights /= weights.sum();
  }

  /// ln of the weighted median of the best speeds.
  [[nodiscard]] double log_best() const {
    std::vector<Index> order(static_cast<std::size_t>(weights.size()));
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Index>(i);
    std::ranges::sort(order, {}, [&](Index i) { return draws.log_best(i); });
    double sum = 0.0;
    for (const Index i : order)
      if ((sum += weights(i)) >= 0.5) return draws.log_best(i);
    return draws.log_best(order.back());
  }

  /// The cut that the library would make next.
  [[nodiscard]] Index most_telling(Index candidates) const {
    const Eigen::VectorXd after = expected_variances(draws.chatter.leftCols(candidates), draws.log_best, weights);
    const Eigen::RowVectorXd risk = weights.transpose() * draws.chatter.leftCols(candidates);
    Index best = -1;
    for (Index i = 0; i < candidates; ++i)
      if (risk(i) <= riskiest_next_cut && (best < 0 || after(i) < after(best))) best = i;
    return best;
  }
};

/// One machine whose cuts have outcomes.
struct Truth {
  const Machines& machines;
  Index number;
  std::mt19937 random;

  bool chatters(Index point) {
    return (static_cast<double>(random()) + 0.5) / 4294967296.0 < machines.chatter(number, point);
  }
  /// True if the posterior's middle lies within 5 % of the truth, which only the test knows.
  [[nodiscard]] bool is_known_to(const Belief& belief) const {
    return std::abs(belief.log_best() - machines.log_best(number)) <= 0.05;
  }
};

constexpr int most_chosen = 30;
constexpr int finest_grid = 7;

/// The number of chosen cuts from which on the posterior's middle stays within 5 % of the truth.
int chosen_cuts(const Machines& draws, Truth truth, Index candidates) {
  Belief belief(draws);
  int needed = truth.is_known_to(belief) ? 0 : 1;
  for (int made = 1; made <= most_chosen; ++made) {
    const Index point = belief.most_telling(candidates);
    if (point < 0) {
      ADD_FAILURE() << "no candidate is safe enough for cut " << made;
      return most_chosen;
    }
    belief.learn(point, truth.chatters(point));
    if (!truth.is_known_to(belief)) needed = made + 1;
  }
  return needed;
}

/// The number of cuts of the coarsest regular grid from which on, with every finer one, the middle is within 5 %. The
/// grids' points stand behind the candidates.
int grid_cuts(const Machines& draws, Truth truth, Index first) {
  int needed = truth.is_known_to(Belief(draws)) ? 0 : 4;
  for (int count = 2; count <= finest_grid; ++count) {
    Belief belief(draws);
    for (int i = 0; i < count * count; ++i, ++first) belief.learn(first, truth.chatters(first));
    if (!truth.is_known_to(belief)) needed = (count + 1) * (count + 1);
  }
  return needed;
}

TEST(BestSpeed, IsNarrowedByTheCutThatTheLibraryMakesNext) {
  Calibration learned;
  learned.model.nominal = nominal_cut();
  learned.model.parameters = milling::uncertain_parameters(learned.model.nominal, {0.1, 0.2, 0.1, 0.15});
  learned.model.options.depth_limit_m = 2.0 * deepest_m;
  learned.model.options.error_tolerance = 1e-2;
  std::mt19937 random(5);
  for (int i = 0; i < 30; ++i)
    learned.draws.push_back(milling::standard_normal(std::ssize(learned.model.parameters) + 1, random));
  const std::vector<double> rpm = milling::spindle_speeds(from_rpm, to_rpm, 12);
  const NextCut cut = next_cut_for_best_speed(learned, 30, rpm, grid_of(8)).value();
  EXPECT_LT(cut.deviation_after, 0.95 * cut.deviation_before);
  EXPECT_LE(cut.chatter_probability, riskiest_next_cut);
  std::vector<std::optional<double>> best;
  for (const milling::Cut& drawn : cuts_of_draws(learned, 30)) {
    std::vector<std::optional<double>> limits;
    for (const double speed : rpm) limits.push_back(limit_at(drawn, speed, learned.model.options));
    best.push_back(best_speed_rpm(rpm, limits));
  }
  const NextCut again = next_cut_for_best_speed(learned, best, grid_of(8)).value();
  EXPECT_EQ(again.point.spindle_speed_rpm, cut.point.spindle_speed_rpm);
  EXPECT_EQ(again.point.depth_m, cut.point.depth_m);
  EXPECT_EQ(again.deviation_before, cut.deviation_before);
}

TEST(BestSpeed, IsKnownByHalfOfTheCutsOfARegularGrid) {
  const bool slow = std::getenv("THINWALL_SLOW") != nullptr;
  const Study study = slow ? Study{2000, 80, 16} : Study{};
  std::vector<milling::OperatingPoint> points = grid_of(study.grid);
  const Index candidates = std::ssize(points);
  for (int count = 2; count <= finest_grid; ++count)
    for (const milling::OperatingPoint& point : grid_of(count)) points.push_back(point);
  const Machines draws = drawn_machines(study.machines, 1, points, study.speeds);
  const Machines truths = drawn_machines(20, 1000, points, study.speeds);
  std::vector<double> chosen, grid;
  for (Index m = 0; m < 20; ++m) {
    const Truth truth{truths, m, std::mt19937(static_cast<unsigned>(m) + 7)};
    chosen.push_back(chosen_cuts(draws, truth, candidates));
    grid.push_back(grid_cuts(draws, truth, candidates));
  }
  EXPECT_LE(core::median(chosen), 0.5 * core::median(grid));
  EXPECT_GT(core::median(grid), 0.0);
}

}  // namespace
}  // namespace thinwall::learning::best_speed_test

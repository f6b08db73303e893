// Coefficients and runout from forces over the angle, with exact and noisy data.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/draws.hpp"
#include "core/error.hpp"
#include "learning/edge_force_fit.hpp"
#include "learning/mean_force_fit.hpp"
#include "milling/cut/cutting_load.hpp"
#include "milling/cut/edge.hpp"
#include "milling/cut/process.hpp"

namespace thinwall::learning::edge_force_test {
namespace {

using std::numbers::pi;

const milling::CuttingCoefficients truth{7.5e8, 2.4e8, -1.1e8, 18e3, 22e3, -3e3};
const std::vector<double> offsets{6e-6, -2e-6, -4e-6};

/// Three teeth of 30 degrees on 10 mm, with runout.
milling::Cutter cutter_with(const std::vector<double>& runout) {
  milling::Cutter cutter;
  cutter.teeth = 3;
  cutter.diameter_m = 0.01;
  cutter.helices_rad = {pi / 6.0, pi / 6.0, pi / 6.0};
  cutter.runout_m = runout;
  return cutter;
}

/// Half immersion against the feed, 2 mm deep, at `count` angles of a turn.
ForceRecord record_at(double feed, int count) {
  const milling::Cutter cutter = cutter_with(offsets);
  ForceRecord record{{0.0, pi / 2.0}, 2e-3, feed, Eigen::VectorXd(count), Eigen::Matrix3Xd(3, count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    record.angle_rad(i) = 2.0 * pi * (static_cast<double>(i) + 0.3) / count;
    record.force_n.col(i) = edge_force_n(cutter, truth, record, record.angle_rad(i));
  }
  return record;
}

TEST(EdgeForces, HaveTheMeanOfATurnWhateverTheRunout) {
  // Every tooth cuts all along this arc: runout takes from one chip what it gives to the next (mean_force_n()).
  ForceRecord record = record_at(6e-5, 3600);
  record.engagement = {0.6, 2.0};
  for (Eigen::Index i = 0; i < 3600; ++i)
    record.force_n.col(i) = edge_force_n(cutter_with(offsets), truth, record, record.angle_rad(i));
  const MeanForceTest test{record.engagement, record.depth_m, record.feed_per_tooth_m};
  const double edge = 1.0 / std::cos(pi / 6.0);  // length per height
  const Eigen::Vector3d mean =
      mean_force_n(3, {truth.K_t, truth.K_r, truth.K_a, edge * truth.K_te, edge * truth.K_re, edge * truth.K_ae}, test);
  EXPECT_LT((record.force_n.rowwise().mean() - mean).norm(), 1e-4 * mean.norm());
}

TEST(EdgeForces, AreThoseOfTheForcedCutWithoutRunout) {
  // milling::cutting_load() integrates the same edges in another way; its angle counts from the first tooth's entry.
  milling::MillingProcess process;
  process.cutter = cutter_with({});
  process.coefficients = truth;
  process.engagement = {0.4, 2.0};
  const ForceRecord record{process.engagement, 3e-3, 5e-5, {}, {}};
  const milling::CutCycle cycle = milling::cut_cycle(process, record.depth_m);
  const milling::EdgeShape shape = milling::edge_shape(process.cutter, record.depth_m);
  const milling::Advance advance = milling::feed_advance(process.cutter, record.feed_per_tooth_m);
  for (const double theta : {0.05, 0.7, 1.3, 1.6}) {
    const Eigen::Vector3d expected =
        milling::cutting_load(process.cutter, cycle, shape, record.depth_m, theta, advance).force;
    const Eigen::Vector3d found = edge_force_n(process.cutter, truth, record, theta + 0.4);
    EXPECT_LE((found - expected).norm(), 1e-8 * expected.norm()) << theta;
  }
}

std::vector<std::pair<FittedCoefficient, double>> all_of(const EdgeForceFit& fit) {
  return {{fit.K_t, truth.K_t},          {fit.K_r, truth.K_r},          {fit.K_a, truth.K_a},
          {fit.K_te, truth.K_te},        {fit.K_re, truth.K_re},        {fit.K_ae, truth.K_ae},
          {fit.runout_m[0], offsets[0]}, {fit.runout_m[1], offsets[1]}, {fit.runout_m[2], offsets[2]}};
}

TEST(EdgeForces, GiveCoefficientsAndRunoutBack) {
  const EdgeForceFit fit = fit_edge_forces(cutter_with({}), {record_at(4e-5, 120), record_at(8e-5, 120)});
  EXPECT_TRUE(fit.converged);
  for (const auto& [found, exact] : all_of(fit)) EXPECT_NEAR(found.value / exact, 1.0, 1e-10);
  EXPECT_NEAR(fit.r_squared, 1.0, 1e-12);
  EXPECT_EQ(fit.degrees_of_freedom, 720 - 8);
}

TEST(EdgeForces, LeaveOutAToothThatReachesNothing) {
  // The runout of 60 µm is more than the feed: the second tooth never reaches the surface that the first one left.
  const std::vector<double> large{6e-5, -5e-5, -1e-5};
  ForceRecord record = record_at(3e-5, 120);
  const milling::Cutter cutter = cutter_with(large);
  for (Eigen::Index i = 0; i < 120; ++i)
    record.force_n.col(i) = edge_force_n(cutter, truth, record, record.angle_rad(i));
  double second = 0.0;
  for (Eigen::Index i = 0; i < 120; ++i) {
    milling::Cutter others = cutter;
    others.runout_m[1] = -1e-3;
    second += (edge_force_n(others, truth, record, record.angle_rad(i)) - record.force_n.col(i)).norm();
  }
  EXPECT_LT(second, 1e-9 * record.force_n.norm());
}

TEST(EdgeForces, HaveIntervalsThatHoldTheTruthInNinetyFivePercentOfDraws) {
  std::mt19937 random(11);
  const std::vector<ForceRecord> exact{record_at(4e-5, 16), record_at(8e-5, 16)};
  int held = 0, all = 0;
  for (int draw = 0; draw < 500; ++draw) {
    std::vector<ForceRecord> noisy = exact;
    for (ForceRecord& record : noisy)
      for (double& force : record.force_n.reshaped()) force += 3.0 * core::normal_draw(random);
    const EdgeForceFit fit = fit_edge_forces(cutter_with({}), noisy);
    EXPECT_TRUE(fit.converged) << draw;
    EXPECT_LE(fit.steps, 10) << draw;
    for (const auto& [found, value] : all_of(fit)) {
      held += std::abs(found.value - value) <= found.half_interval ? 1 : 0;
      ++all;
    }
  }
  EXPECT_GE(static_cast<double>(held) / all, 0.93);
  EXPECT_LE(static_cast<double>(held) / all, 0.97);
}

TEST(EdgeForces, AreFittedThoughThoseWithoutHelixJumpWithTheRunout) {
  std::mt19937 random(11);
  milling::Cutter straight = cutter_with({}), with_runout = cutter_with(offsets);
  straight.helices_rad = with_runout.helices_rad = {};
  for (int draw = 0; draw < 100; ++draw) {
    std::vector<ForceRecord> records{record_at(4e-5, 120), record_at(8e-5, 120)};
    for (ForceRecord& record : records) {
      for (Eigen::Index i = 0; i < record.angle_rad.size(); ++i) {
        record.force_n.col(i) = edge_force_n(with_runout, truth, record, record.angle_rad(i));
        for (double& force : record.force_n.col(i)) force += 3.0 * core::normal_draw(random);
      }
    }
    const EdgeForceFit fit = fit_edge_forces(straight, records);
    EXPECT_TRUE(fit.converged) << draw;
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(fit.runout_m[j].value, offsets[j], 5.0 * fit.runout_m[j].deviation) << draw;
  }
}

TEST(EdgeForces, SayWhatIsMissing) {
  ForceRecord bad = record_at(4e-5, 12);
  bad.depth_m = 0.0;
  EXPECT_THROW((void)fit_edge_forces(cutter_with({}), {bad}), core::InputError);
  ForceRecord few = record_at(4e-5, 12);
  few.angle_rad = few.angle_rad.head(2).eval();
  few.force_n = few.force_n.leftCols(2).eval();
  try {
    (void)fit_edge_forces(cutter_with({}), {few});
    FAIL() << "accepted";
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("condition"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace thinwall::learning::edge_force_test

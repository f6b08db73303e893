// Power, torque and removal rate of a static cut, and pockets within a machine's limits.

#include "milling/chart/machine_limits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "core/error.hpp"
#include "milling/chart/pockets.hpp"
#include "milling/forced/forced_vibration.hpp"

namespace thinwall::milling::machine_limits_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double feed = 0.08e-3;

MillingProcess cut(double radial_depth_m, MillingDirection direction, double K_te = 0.0) {
  MillingProcess process;
  process.cutter = {3, 0.012};
  process.coefficients = {7e8, 3e8, 1e8, K_te, 5e3, 0.0};
  process.engagement = engagement_of(process.cutter, radial_depth_m, direction);
  return process;
}

TEST(CutLoad, OfASlotIsSpecificForceTimesRemovalRate) {
  const CutLoad load = cut_load(cut(0.012, MillingDirection::up), feed);
  EXPECT_NEAR(load.torque_per_depth_N, 3.0 * 0.012 * 7e8 * feed / (2.0 * pi), 1e-9);
  EXPECT_NEAR(load.removal_per_depth_turn_m2, 0.012 * 3.0 * feed, 1e-18);
  // Power 2π n/60 M = K_t times the volume removed a second, whatever the speed.
  EXPECT_NEAR(2.0 * pi * load.torque_per_depth_N, 7e8 * load.removal_per_depth_turn_m2, 1e-9);
}

TEST(CutLoad, RemovesRadialDepthTimesFeed) {
  for (const double radial : {0.4e-3, 3e-3, 11e-3}) {
    for (const auto direction : {MillingDirection::up, MillingDirection::down})
      EXPECT_NEAR(cut_load(cut(radial, direction), feed).removal_per_depth_turn_m2, radial * 3.0 * feed, 1e-18);
  }
}

TEST(CutLoad, TorqueIsTheMeanOfTheTeethSummedOverATurn) {
  const MillingProcess process = cut(5e-3, MillingDirection::down, 2e4);
  const int steps = 300000;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    for (int tooth = 0; tooth < 3; ++tooth) {
      const double phi = std::fmod(2.0 * pi * (i + 0.5) / steps + 2.0 * pi * tooth / 3.0, 2.0 * pi);
      if (phi > process.engagement.entry_rad && phi < process.engagement.exit_rad)
        sum += 0.006 * (7e8 * feed * std::sin(phi) + 2e4);
    }
  }
  EXPECT_NEAR(cut_load(process, feed).torque_per_depth_N, sum / steps, 2e-5 * sum / steps);
}

TEST(CutLoad, IsTheMeanTorqueOfTheForcedVibrationOfAHelicalCut) {
  MillingProcess process = cut(5e-3, MillingDirection::down, 2e4);
  process.cutter.helices_rad = {0.6, 0.6, 0.6};
  RelativeStructure structure;
  structure.poles.resize(1);
  structure.poles << std::complex<double>(-50.0, 5000.0);
  structure.phi = Eigen::Vector3cd::UnitX();
  structure.b = Eigen::Vector3cd::UnitX() / std::complex<double>(0.0, 1e4);
  const double depth = 1e-4;
  const ForcedVibration forced = forced_vibration(structure, process, 6000.0, depth, feed);
  EXPECT_NEAR(cut_load(process, feed).torque_per_depth_N * depth / forced.mean_torque_n_m, 1.0, 1e-6);
}

TEST(CutLoad, WithoutEdgeForcesHelixAndUnequalPitchesDoNotChangeIt) {
  const MillingProcess straight = cut(5e-3, MillingDirection::down);
  MillingProcess other = straight;
  other.cutter.helices_rad = {0.5, 0.5, 0.6};
  other.cutter.pitches_rad = {1.9, 2.1, 2.0 * pi - 4.0};
  EXPECT_NEAR(cut_load(other, feed).torque_per_depth_N, cut_load(straight, feed).torque_per_depth_N, 1e-10);
}

TEST(CutLoad, TeethBehindTheToolCutNothing) {
  MillingProcess process = cut(0.012, MillingDirection::up, 2e4);
  const CutLoad slot = cut_load(process, feed);
  process.engagement = {-0.5 * pi, 1.5 * pi};
  const CutLoad turn = cut_load(process, feed);
  EXPECT_NEAR(turn.torque_per_depth_N, slot.torque_per_depth_N, 1e-12);
  EXPECT_NEAR(turn.removal_per_depth_turn_m2, slot.removal_per_depth_turn_m2, 1e-18);
}

TEST(CutLoad, RefusesBadFeedsAndRoundEnds) {
  MillingProcess process = cut(5e-3, MillingDirection::down);
  for (const double bad : {0.0, -1e-4, std::nan(""), MachineLimits::none})
    EXPECT_THROW((void)cut_load(process, bad), core::InputError) << bad;
  process.cutter.envelope = ball_end(0.012);
  EXPECT_THROW((void)cut_load(process, feed), core::InputError);
}

TEST(MachineLimits, OfTorqueAndPowerBoundTheDepth) {
  const CutLoad load = cut_load(cut(0.012, MillingDirection::up), feed);
  MachineLimits machine;
  EXPECT_EQ(depth_for_torque(load, machine), MachineLimits::none);
  EXPECT_EQ(depth_for_power(load, machine, 5000.0), MachineLimits::none);
  EXPECT_EQ(speed_for_feed_rate(load, machine), MachineLimits::none);
  machine.max_torque_Nm = 4.0;
  machine.max_power_W = 3e3;
  machine.efficiency = 0.8;
  machine.max_feed_rate_m_s = 0.05;
  EXPECT_NEAR(depth_for_torque(load, machine) * load.torque_per_depth_N, 4.0, 1e-12);
  // 80 % of 3 kW remove 2.4 kW / K_t a second.
  EXPECT_NEAR(depth_for_power(load, machine, 5000.0) * load.removal_per_depth_turn_m2 * 5000.0 / 60.0, 2400.0 / 7e8,
              1e-15);
  EXPECT_NEAR(speed_for_feed_rate(load, machine) / 60.0 * 3.0 * feed, 0.05, 1e-12);
}

TEST(MachineLimits, AreRefusedWhereTheyCannotBe) {
  const auto violations = [](auto change) {
    MachineLimits machine;
    change(machine);
    return validate(machine).size();
  };
  EXPECT_EQ(validate(MachineLimits{}).size(), 0u);
  for (const double bad : {0.0, -1.0, std::nan("")}) {
    EXPECT_EQ(violations([&](MachineLimits& m) { m.max_power_W = bad; }), 1u) << bad;
    EXPECT_EQ(violations([&](MachineLimits& m) { m.max_torque_Nm = bad; }), 1u) << bad;
    EXPECT_EQ(violations([&](MachineLimits& m) { m.max_feed_rate_m_s = bad; }), 1u) << bad;
    EXPECT_EQ(violations([&](MachineLimits& m) { m.efficiency = bad; }), 1u) << bad;
    EXPECT_EQ(violations([&](MachineLimits& m) { m.max_spindle_speed_rpm = bad; }), 1u) << bad;
  }
  EXPECT_EQ(violations([](MachineLimits& m) { m.efficiency = 1.1; }), 1u);
}

std::vector<LobeRow> chart(const std::vector<std::pair<double, double>>& points, double limit = MachineLimits::none) {
  std::vector<LobeRow> rows(points.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].spindle_speed_rpm = points[i].first;
    rows[i].limiting_depth_m = std::min(limit, points[i].second);
    rows[i].at_limit = points[i].second >= limit;
  }
  return rows;
}

// Speed times depth rises to 4000 rpm, falls, and rises again to 6000 rpm.
const std::vector<std::pair<double, double>> two_pockets{{3000, 2e-3}, {3500, 4e-3}, {4000, 6e-3}, {4500, 3e-3},
                                                         {5000, 2e-3}, {5500, 5e-3}, {6000, 8e-3}, {6500, 4e-3}};

TEST(PocketsOfAMachine, RankByDepthAndSayTheirWidth) {
  const CutLoad load = cut_load(cut(5e-3, MillingDirection::down), feed);
  const auto pockets = best_pockets(chart(two_pockets, 7.5e-3), {}, load, 5);
  ASSERT_EQ(pockets.size(), 2u);
  EXPECT_EQ(pockets[0].limited_by, PocketLimit::depth_limit);
  EXPECT_NEAR(*pockets[0].removal_rate_m3_s, 7.5e-3 * 5e-3 * feed * 3.0 * 6000.0 / 60.0, 1e-15);
  EXPECT_EQ(pockets[1].limited_by, PocketLimit::stability);
  EXPECT_EQ(pockets[1].spindle_speed_rpm, 4000.0);
  const auto without_feed = best_pockets(chart(two_pockets), {}, {}, 5);
  ASSERT_EQ(without_feed.size(), 2u);
  EXPECT_FALSE(without_feed[0].removal_rate_m3_s.has_value());
}

TEST(PocketsOfAMachine, OfAnEdgeOfTheChartComeLast) {
  std::vector<std::pair<double, double>> rising = two_pockets;
  rising.emplace_back(7000.0, 20e-3);
  const auto pockets = best_pockets(chart(rising), {}, {}, 5);
  ASSERT_EQ(pockets.size(), 3u);
  EXPECT_EQ(pockets[0].spindle_speed_rpm, 6000.0);
  EXPECT_FALSE(pockets[0].at_chart_edge);
  EXPECT_EQ(pockets[2].spindle_speed_rpm, 7000.0) << "the deepest of all";
  EXPECT_TRUE(pockets[2].at_chart_edge);
  // 8 mm at 6000 rpm beside 5 and 4 mm: 7.2 mm are left 500·0.8/3 below and 500·0.8/4 above.
  EXPECT_NEAR(pockets[0].from_rpm, 6000.0 - 500.0 * 0.8 / 3.0, 1e-9);
  EXPECT_NEAR(pockets[0].to_rpm, 6000.0 + 500.0 * 0.8 / 4.0, 1e-9);
}

/// Beside the nose of a flip lobe the deepest row may be one that the lines leave open.
TEST(PocketsOfAMachine, ARowThatIsNoAnswerIsNoneAndHidesNone) {
  std::vector<LobeRow> rows = chart({{4000, 2e-3}, {4500, 6e-3}, {5000, 8e-3}, {5500, 5.9e-3}, {6000, 2e-3}});
  ASSERT_EQ(best_pockets(rows, {}, {}, 5).front().spindle_speed_rpm, 5000.0);
  for (const auto status : {StabilityStatus::data_insufficient, StabilityStatus::crossing_missed}) {
    rows[2].status = status;
    const auto pockets = best_pockets(rows, {}, {}, 5);
    ASSERT_EQ(pockets.size(), 1u) << name(status);
    EXPECT_EQ(pockets[0].spindle_speed_rpm, 5500.0) << "of the two rows beside it that by which more is removed";
    EXPECT_EQ(pockets[0].from_rpm, 5500.0) << "what can be cut at 5000 rpm is not known";
  }
  for (const auto status : {StabilityStatus::data_limited, StabilityStatus::node_limit_reached}) {
    rows[2].status = status;
    EXPECT_EQ(best_pockets(rows, {}, {}, 5).front().spindle_speed_rpm, 5000.0) << "its error is said: " << name(status);
  }
  rows[2].error_estimate = 0.2;
  EXPECT_EQ(best_pockets(rows, {}, {}, 5).front().spindle_speed_rpm, 5500.0) << "the nodes left a fifth open";
  for (LobeRow& row : rows) row.status = StabilityStatus::data_insufficient;
  EXPECT_TRUE(best_pockets(rows, {}, {}, 5).empty());
}

TEST(PocketsOfAMachine, TorqueCutsDepthAndPowerMakesAPlateau) {
  const CutLoad load = cut_load(cut(5e-3, MillingDirection::down), feed);
  MachineLimits machine;
  machine.max_torque_Nm = 5e-3 * load.torque_per_depth_N;
  auto pockets = best_pockets(chart(two_pockets), machine, load, 5);
  ASSERT_EQ(pockets.size(), 2u);
  EXPECT_EQ(pockets[0].spindle_speed_rpm, 6000.0);
  EXPECT_NEAR(pockets[0].depth_m, 5e-3, 1e-15);
  EXPECT_EQ(pockets[0].limited_by, PocketLimit::torque);
  machine = {};
  machine.max_power_W = 2.0 * pi * 5500.0 / 60.0 * 5e-3 * load.torque_per_depth_N;
  pockets = best_pockets(chart(two_pockets), machine, load, 5);
  ASSERT_EQ(pockets.size(), 2u) << "a plateau of constant power is one pocket";
  EXPECT_EQ(pockets[1].limited_by, PocketLimit::stability) << "the power is just enough at 5500 rpm";
  EXPECT_EQ(pockets[1].spindle_speed_rpm, 5500.0);
  machine.max_power_W *= 0.8;
  pockets = best_pockets(chart(two_pockets), machine, load, 5);
  EXPECT_EQ(pockets[0].limited_by, PocketLimit::power);
  EXPECT_NEAR(pockets[0].depth_m * pockets[0].spindle_speed_rpm, 0.8 * 5500.0 * 5e-3, 1e-9);
}

TEST(PocketsOfAMachine, EndWhereItsSpeedsEnd) {
  const CutLoad load = cut_load(cut(5e-3, MillingDirection::down), feed);
  MachineLimits machine;
  machine.max_spindle_speed_rpm = 5600.0;
  auto pockets = best_pockets(chart(two_pockets), machine, load, 5);
  ASSERT_EQ(pockets.size(), 2u);
  EXPECT_EQ(pockets[1].spindle_speed_rpm, 5500.0);
  EXPECT_EQ(pockets[1].limited_by, PocketLimit::spindle_speed);
  EXPECT_EQ(pockets[0].limited_by, PocketLimit::stability) << "deeper, though less is removed";
  machine.max_feed_rate_m_s = 3.0 * feed * 5100.0 / 60.0;
  machine.min_spindle_speed_rpm = 4400.0;
  pockets = best_pockets(chart(two_pockets), machine, load, 5);
  ASSERT_EQ(pockets.size(), 1u);
  EXPECT_EQ(pockets[0].spindle_speed_rpm, 4500.0);
  EXPECT_EQ(pockets[0].limited_by, PocketLimit::spindle_speed) << "it would cut more at 4000 rpm";
  machine.min_spindle_speed_rpm = 4900.0;
  machine.max_feed_rate_m_s = 3.0 * feed * 5600.0 / 60.0;
  machine.max_spindle_speed_rpm = 5800.0;
  pockets = best_pockets(chart(two_pockets), machine, load, 5);
  ASSERT_EQ(pockets.size(), 1u);
  EXPECT_EQ(pockets[0].limited_by, PocketLimit::feed_rate);
  machine.max_power_W = -1.0;
  EXPECT_THROW((void)best_pockets(chart(two_pockets), machine, load, 5), core::InputError);
}

}  // namespace
}  // namespace thinwall::milling::machine_limits_test

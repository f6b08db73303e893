#include "milling/chart/lobes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "milling/structure/regenerative_loop.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::milling::lobes_test {
namespace {

using testing::modal_model;

RelativeStructure structure_of(const std::vector<testing::Mode>& modes) {
  return relative_structure(modal_model(modes), "P");
}

const std::vector<testing::Mode> wall{{212.0, 0.01, 0.5, Eigen::Vector3d(1.0, 0.2, 0.1)},
                                      {567.0, 0.02, 0.4, Eigen::Vector3d(0.8, -0.3, 0.0)}};

MillingProcess wall_cut(MillingDirection direction) {
  MillingProcess process;
  process.cutter = {6, 0.016};
  process.coefficients = {2e9, 0.8e9, 0.3e9, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, 0.2e-3, direction);
  process.frame = {Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
  return process;
}

TEST(Lobes, TurningLimitIsTheClosedForm) {
  // z ≥ 3 teeth in full immersion with K_t = 0 act as one constant K = z K_r/2 along x with the delay T: turning. At
  // frequency ratio r: K w/k = ((1−r²)² + 4ζ²r²)/(2(r²−1)), 1/T = ω_n/2π · rπ/(jπ − atan((r²−1)/(2ζr))).
  const double zeta = 0.02;
  const double r = 1.05;
  const double hz = 150.0;
  const double mass = 0.8;
  const double omega = 2.0 * std::numbers::pi * hz;
  const double stiffness = mass * omega * omega;
  MillingProcess process;
  process.cutter = {4, 0.01};
  process.coefficients = {0.0, 3e8, 0.0, 0.0, 0.0, 0.0};
  process.engagement = {0.0, 2.0 * std::numbers::pi};
  StabilityOptions options;
  options.error_tolerance = 1e-9;
  options.depth_limit_m = 0.05;
  const double r2 = r * r;
  const double depth = stiffness * (std::pow(1.0 - r2, 2) + 4.0 * zeta * zeta * r2) / (2.0 * (r2 - 1.0)) / (2.0 * 3e8);
  for (const int j : {1, 2, 3}) {
    const double delay_rate =
        hz * r * std::numbers::pi / (j * std::numbers::pi - std::atan((r2 - 1.0) / (2.0 * zeta * r)));
    const LobeRow row = limiting_depth(structure_of({{hz, zeta, mass, Eigen::Vector3d::UnitX()}}), process,
                                       delay_rate * 60.0 / 4.0, options);
    EXPECT_NEAR(row.limiting_depth_m / depth, 1.0, row.error_estimate + 1e-11) << "lobe " << j;
    EXPECT_LE(row.error_estimate, 1e-9);
    EXPECT_NEAR(row.chatter_frequency_hz, r * hz, 1e-6) << "lobe " << j;
    EXPECT_EQ(row.kind, Bifurcation::hopf);
  }
}

TEST(Lobes, IsotropicStructureDoesNotFeelTheSenseOfMilling) {
  const RelativeStructure s =
      structure_of({{400.0, 0.02, 0.5, Eigen::Vector3d::UnitX()}, {400.0, 0.02, 0.5, Eigen::Vector3d::UnitY()}});
  for (const double rpm : {1500.0, 2200.0}) {
    const Multiplier up = multiplier_at(s, wall_cut(MillingDirection::up), rpm, 3e-3, {});
    const Multiplier down = multiplier_at(s, wall_cut(MillingDirection::down), rpm, 3e-3, {});
    EXPECT_NEAR(up.modulus / down.modulus, 1.0, up.error_estimate + down.error_estimate);
  }
}

TEST(Lobes, TwiceTheReceptanceHalvesTheDepth) {
  const RelativeStructure one = structure_of(wall);
  for (const double rpm : {1300.0, 1900.0}) {
    const MillingProcess process = wall_cut(MillingDirection::down);
    const LobeRow single = limiting_depth(one, process, rpm, {});
    const LobeRow twice = limiting_depth(sum(one, one), process, rpm, {});
    EXPECT_NEAR(2.0 * twice.limiting_depth_m / single.limiting_depth_m, 1.0,
                single.error_estimate + twice.error_estimate);
  }
}

TEST(Lobes, StiffenerBehindTheWallRaisesTheMinimum) {
  // The same modal masses and damping constants with 20 times the damping ratio of the first mode and 1.4 times its
  // frequency, as a robot behind the wall does.
  std::vector<testing::Mode> backed = wall;
  backed[0].frequency_hz *= 1.4;
  backed[0].damping_ratio = 0.2;
  backed[1].damping_ratio = 0.1;
  const auto speeds = spindle_speeds(1000.0, 3000.0, 21);
  const Lobes alone = stability_lobes(structure_of(wall), wall_cut(MillingDirection::down), speeds, {});
  const Lobes held = stability_lobes(structure_of(backed), wall_cut(MillingDirection::down), speeds, {});
  EXPECT_GT(held.minimum_depth_m, 3.0 * alone.minimum_depth_m);
  EXPECT_EQ(alone.rows_not_converged, 0);
  EXPECT_LE(alone.worst_error_estimate, 1e-4);
}

TEST(Lobes, DoNotDependOnTheNumberOfThreads) {
  const auto speeds = spindle_speeds(1000.0, 3000.0, 12);
  const int before = core::thread_count();
  core::set_thread_count(1);
  const Lobes one = stability_lobes(structure_of(wall), wall_cut(MillingDirection::down), speeds, {});
  core::set_thread_count(3);
  const Lobes three = stability_lobes(structure_of(wall), wall_cut(MillingDirection::down), speeds, {});
  core::set_thread_count(before);
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    EXPECT_EQ(one.rows[i].limiting_depth_m, three.rows[i].limiting_depth_m);
    EXPECT_EQ(one.rows[i].chatter_frequency_hz, three.rows[i].chatter_frequency_hz);
  }
}

TEST(Lobes, StableUpToTheLimitIsSaidAndNotCut) {
  StabilityOptions options;
  options.depth_limit_m = 1e-5;
  const LobeRow row = limiting_depth(structure_of(wall), wall_cut(MillingDirection::down), 1900.0, options);
  EXPECT_TRUE(row.at_limit);
  EXPECT_EQ(row.status, StabilityStatus::stable_to_depth_limit);
  EXPECT_EQ(row.limiting_depth_m, 1e-5);
}

TEST(Lobes, MultiplierCrossesOneAtTheLimitingDepth) {
  for (const double rpm : {1100.0, 1900.0, 2700.0}) {
    const MillingProcess process = wall_cut(MillingDirection::down);
    const LobeRow row = limiting_depth(structure_of(wall), process, rpm, {});
    EXPECT_LT(multiplier_at(structure_of(wall), process, rpm, 0.999 * row.limiting_depth_m, {}).modulus, 1.0);
    EXPECT_GT(multiplier_at(structure_of(wall), process, rpm, 1.001 * row.limiting_depth_m, {}).modulus, 1.0);
  }
}

TEST(Lobes, FlipsOfACoarseGridThatAreAHopfCrossingOnFinerOnesAreNotMissed) {
  // Two multipliers meet at −1: with 8 to 12 nodes two real ones cross, with more a complex pair 0.007 rad beside.
  const double s = 38.0 / 49.0;
  const RelativeStructure structure =
      structure_of({{400.0 * (1.0 + 0.1 * s), 0.01, 0.5, std::sin(1.0 + 3.0 * s) * Eigen::Vector3d(1.0, 0.1, 0.0)},
                    {730.0 * (1.0 - 0.05 * s), 0.015, 0.4, std::cos(2.0 + 5.0 * s) * Eigen::Vector3d(1.0, -0.2, 0.1)},
                    {1210.0, 0.008, 0.6, Eigen::Vector3d(0.3, 1.0, 0.1)}});
  MillingProcess process = wall_cut(MillingDirection::up);
  process.cutter = {3, 0.016};
  process.coefficients = {6e8, 2e8, 0.5e8, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, 6e-3, MillingDirection::up);
  const double rpm = 4000.0 + 12000.0 * 49.0 / 399.0;
  StabilityOptions options;
  options.follow = 1.0;
  for (const double expected : {4.5e-3, 4.9e-3, 5.5e-3}) {
    options.expected_depth_m = expected;
    const LobeRow row = limiting_depth(structure, process, rpm, options);
    EXPECT_EQ(row.status, StabilityStatus::converged) << expected;
    EXPECT_LT(multiplier_at(structure, process, rpm, 0.999 * row.limiting_depth_m, {}).modulus, 1.0);
    EXPECT_GT(multiplier_at(structure, process, rpm, 1.001 * row.limiting_depth_m, {}).modulus, 1.0);
  }
}

TEST(Lobes, NodeLimitIsAStatusWithTheErrorThatRemains) {
  StabilityOptions options;
  options.most_nodes = 8;
  options.error_tolerance = 1e-9;
  const LobeRow row = limiting_depth(structure_of(wall), wall_cut(MillingDirection::down), 1100.0, options);
  EXPECT_EQ(row.status, StabilityStatus::node_limit_reached);
  EXPECT_GT(row.error_estimate, 1e-9);
}

TEST(Lobes, CrossingsTellTheCountOfUnstableMultipliersAtEveryDepth) {
  // A chart's worth of speeds and depths up to forty times the limit; the count by eigenvalues of the period map.
  const MillingProcess process = wall_cut(MillingDirection::down);
  const RelativeStructure structure = structure_of(wall);
  const RelativeStructure in_tool = in_tool_axes(structure, process.frame);
  const ContactGrid grid = contact_grid(process, yielding_directions(in_tool), {2, 12});
  int gaps = 0;
  int compared = 0;
  for (const double rpm : spindle_speeds(900.0, 3300.0, 61)) {
    const LobeRow row = limiting_depth(structure, process, rpm, {});
    ASSERT_TRUE(row.status == StabilityStatus::converged || row.status == StabilityStatus::stable_to_depth_limit);
    const RegenerativeLoop loop = regenerative_loop(in_tool, grid, rpm);
    for (const LobePoint& point : row.crossings) gaps += point.unstable_change < 0 ? 1 : 0;
    for (double depth = 0.9e-3; depth < row.searched_m; depth *= 1.23) {
      int by_crossings = 0;
      bool beside = false;
      bool unresolved = false;  // deep in the unstable range, where the coarse grid that is searched may differ
      for (const LobePoint& point : row.crossings) {
        by_crossings += point.depth_m < depth ? point.unstable_change : 0;
        beside = beside || std::abs(point.depth_m / depth - 1.0) < 10.0 * point.error_estimate + 1e-6;
        unresolved = unresolved || (point.error_estimate > 1e-3 && point.depth_m < 1.5 * depth);
      }
      if (beside || unresolved) continue;
      ++compared;
      const Eigen::VectorXcd multipliers = Eigen::MatrixXd(period_map(loop, depth)).eigenvalues();
      EXPECT_EQ(by_crossings, (multipliers.cwiseAbs().array() > 1.0).count()) << rpm << " rpm, " << depth << " m";
    }
  }
  EXPECT_GT(gaps, 0) << "the test should see multipliers return";
  EXPECT_GT(compared, 300);
}

TEST(Lobes, StaticResidualActsAsAStiffModeDoes) {
  // A mode far above everything else, or its static compliance: the same chart, the closer the stiffer.
  RelativeStructure with_static = structure_of(wall);
  const double hz = 60000.0;
  const double mass = 2e-5;
  with_static.R(0, 0) = 1.0 / (mass * std::pow(2.0 * std::numbers::pi * hz, 2));
  std::vector<testing::Mode> modes = wall;
  modes.push_back({hz, 0.5, mass, Eigen::Vector3d::UnitX()});
  StabilityOptions options;
  options.depth_limit_m = 0.05;
  for (const double rpm : {1300.0, 2380.0}) {
    const MillingProcess process = wall_cut(MillingDirection::down);
    const double as_static = limiting_depth(with_static, process, rpm, options).limiting_depth_m;
    const double as_mode = limiting_depth(structure_of(modes), process, rpm, options).limiting_depth_m;
    const double without = limiting_depth(structure_of(wall), process, rpm, options).limiting_depth_m;
    EXPECT_NEAR(as_static / as_mode, 1.0, 0.02 * std::abs(without / as_mode - 1.0) + 2e-4);
    EXPECT_GT(std::abs(without / as_mode - 1.0), 5e-3) << "the residual should matter here";
  }
}

TEST(Lobes, RefuseBadInput) {
  const RelativeStructure s = structure_of(wall);
  const MillingProcess good = wall_cut(MillingDirection::down);
  MillingProcess bad = good;
  bad.cutter.teeth = 0;
  EXPECT_THROW((void)stability_lobes(s, bad, {1000.0}, {}), core::InputError);
  EXPECT_THROW((void)stability_lobes(s, good, {}, {}), core::InputError);
  EXPECT_THROW((void)stability_lobes(s, good, {1000.0, 0.0}, {}), core::InputError);
  EXPECT_THROW((void)multiplier_at(s, good, 1000.0, -1e-3, {}), core::InputError);
  EXPECT_THROW((void)spindle_speeds(0.0, 1000.0, 10), core::InputError);
  EXPECT_THROW((void)spindle_speeds(1000.0, 1000.0, 10), core::InputError);
  StabilityOptions options;
  options.depth_limit_m = 0.0;
  options.most_nodes = 1;
  options.error_tolerance = 0.0;
  EXPECT_EQ(validate(options).size(), 3u);
  EXPECT_THROW((void)limiting_depth(s, good, 1000.0, options), core::InputError);
}

TEST(Lobes, TheErrorOfAChartIsAlsoThatOfRowsAtTheLimitWhichMissedTheTolerance) {
  LobeRow sound, missed;
  sound.at_limit = missed.at_limit = true;
  sound.error_estimate = 0.3;  // of |μ|, which is far below 1
  sound.status = StabilityStatus::stable_to_depth_limit;
  missed.error_estimate = 0.1;
  missed.status = StabilityStatus::node_limit_reached;
  EXPECT_EQ(lobes_of({sound}, "").worst_error_estimate, 0.0);
  EXPECT_EQ(lobes_of({sound, missed}, "").worst_error_estimate, 0.1);
}

}  // namespace
}  // namespace thinwall::milling::lobes_test

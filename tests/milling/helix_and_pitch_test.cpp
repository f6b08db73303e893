// Cutters with helix and unequal pitches: against equal teeth, closed forms, and the linear equation marched in time.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "milling/direct/stability.hpp"
#include "tests/milling/marching.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::milling::helix_and_pitch_test {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

const std::vector<testing::Mode> modes{{500.0, 0.02, 0.05, Eigen::Vector3d::UnitX()},
                                       {700.0, 0.03, 0.08, Eigen::Vector3d::UnitY()}};

RelativeStructure structure() {
  return relative_structure(testing::modal_model(modes), "P");
}

MillingProcess process_with(Cutter cutter, double entry_rad, double exit_rad) {
  MillingProcess process;
  process.cutter = std::move(cutter);
  process.coefficients = {6e8, 2e8, 0.0, 0.0, 0.0, 0.0};
  process.engagement = {entry_rad, exit_rad};
  return process;
}

StabilityOptions sharp() {
  StabilityOptions options;
  options.error_tolerance = 1e-8;
  return options;
}

TEST(Pitch, NearlyEqualTeethOverATurnAreEqualTeethOverAPitch) {
  // Pitches that differ by a ten-millionth go the way of unequal ones: a turn's multiplier is the product of the
  // pitches'. A short cut, and one with two and three teeth at a time.
  for (const double arc : {40.0 * degree, 200.0 * degree}) {
    const double p = 0.5 * std::numbers::pi;
    const double off = 1e-7;
    const MillingProcess equal = process_with({4, 0.012}, 10.0 * degree, 10.0 * degree + arc);
    const MillingProcess unequal =
        process_with({4, 0.012, {p + off, p - off, p + off, p - off}}, 10.0 * degree, 10.0 * degree + arc);
    for (const double rpm : {6000.0, 9500.0}) {
      const Multiplier pitch = multiplier_at(structure(), equal, rpm, 0.3e-3, sharp());
      const Multiplier turn = multiplier_at(structure(), unequal, rpm, 0.3e-3, sharp());
      EXPECT_NEAR(turn.modulus / std::pow(pitch.modulus, 4), 1.0, 3e-6) << arc << " rad, " << rpm << " rpm";
    }
  }
}

/// At these five speeds of seven hundred the search looked at depths at which a multiplier of these nearly equal teeth
/// is infinite (I + wK singular to round-off), and the row ended with an exception.
TEST(Pitch, NearlyEqualTeethHaveTheirMultipliersAtEverySpeed) {
  const auto mode = [](double hz, double damping, double stiffness, const Eigen::Vector3d& direction) {
    return testing::Mode{hz, damping, stiffness / std::pow(2.0 * std::numbers::pi * hz, 2), direction};
  };
  const RelativeStructure structure = relative_structure(
      testing::modal_model(
          {mode(1174.8597994419392, 0.013287403398718999, 37947321.061175555, Eigen::Vector3d::UnitX()),
           mode(1436.440069456884, 0.006363225169135556, 6036219.569822568, Eigen::Vector3d::UnitY()),
           mode(1376.4059241453647, 0.021437120425240434, 2013384.23993829, Eigen::Vector3d::UnitY())}),
      "P");
  MillingProcess process;
  process.cutter = {2, 0.012};
  constexpr double degree = std::numbers::pi / 180.0;
  process.cutter.pitches_rad = {179.5514 * degree, 180.4486 * degree};
  process.coefficients = {1408.6e6, 362.9e6};
  process.engagement = engagement_of(process.cutter, 0.00856, MillingDirection::down);
  process.frame.feed = Eigen::Vector3d::UnitY();
  StabilityOptions options;
  options.depth_limit_m = 0.03;
  for (const double rpm :
       {5947.9113018598, 6032.589413447782, 6738.240343347639, 7330.98712446352, 8798.741058655221}) {
    const LobeRow row = limiting_depth(structure, process, rpm, options);
    EXPECT_EQ(row.status, StabilityStatus::converged) << rpm;
    EXPECT_LT(multiplier_at(structure, process, rpm, 0.998 * row.limiting_depth_m, options).modulus, 1.0) << rpm;
    EXPECT_GT(multiplier_at(structure, process, rpm, 1.002 * row.limiting_depth_m, options).modulus, 1.0) << rpm;
  }
}

TEST(Pitch, UnequalPitchesAgainstMarchingInTime) {
  const MillingProcess process =
      process_with({4, 0.012, {80.0 * degree, 100.0 * degree, 70.0 * degree, 110.0 * degree}}, 0.0, 60.0 * degree);
  for (const double rpm : {5000.0, 10000.0}) {
    const double depth = 0.9e-3;
    const Multiplier exact = multiplier_at(structure(), process, rpm, depth, sharp());
    EXPECT_EQ(exact.status, StabilityStatus::converged);
    EXPECT_EQ(exact.kind, Bifurcation::hopf);
    EXPECT_NEAR(testing::Marching(process, modes, rpm, depth, 1800).modulus_of_turn(30) / exact.modulus, 1.0, 1e-4)
        << rpm;
  }
}

TEST(Helix, AgainstMarchingInTime) {
  const MillingProcess process =
      process_with({3, 0.012, {}, {30.0 * degree, 30.0 * degree, 30.0 * degree}}, 120.0 * degree, 180.0 * degree);
  const double rpm = 12000.0;
  const double depth = 2e-3;
  const Multiplier exact = multiplier_at(structure(), process, rpm, depth, sharp());
  EXPECT_EQ(exact.status, StabilityStatus::converged);
  EXPECT_NEAR(testing::Marching(process, modes, rpm, depth, 1440).modulus_of_turn(24) / std::pow(exact.modulus, 3), 1.0,
              1e-4);
}

TEST(Helix, UnequalHelicesAgainstMarchingInTime) {
  // The delay changes along the edges.
  const MillingProcess process =
      process_with({2, 0.012, {}, {25.0 * degree, 40.0 * degree}}, 120.0 * degree, 180.0 * degree);
  const double rpm = 12000.0;
  const double depth = 2e-3;
  StabilityOptions options;
  options.error_tolerance = 1e-5;
  const Multiplier exact = multiplier_at(structure(), process, rpm, depth, options);
  EXPECT_EQ(exact.status, StabilityStatus::converged);
  EXPECT_NEAR(testing::Marching(process, modes, rpm, depth, 1440).modulus_of_turn(30) / exact.modulus, 1.0, 1e-4);
}

TEST(Helix, WholePitchOfEdgeInTheDepthMakesTheForceConstant) {
  // At w = πD/(z tan β) the directional matrix does not depend on time: turning, with a closed form (see lobes_test).
  const double zeta = 0.02;
  const double r = 1.05;
  const double hz = 150.0;
  const double mass = 20.0;
  const double omega = 2.0 * std::numbers::pi * hz;
  const double stiffness = mass * omega * omega;
  const double diameter = 0.01;
  const int teeth = 3;
  MillingProcess process = process_with({teeth, diameter}, 20.0 * degree, 150.0 * degree);
  process.coefficients = {3e8, 2e8, 0.0, 0.0, 0.0, 0.0};
  const double share = teeth * process.engagement.arc_rad() / (2.0 * std::numbers::pi);
  const double per_depth = share * mean_directional_matrix(process.coefficients, process.engagement.entry_rad,
                                                           process.engagement.exit_rad)(0, 0);
  const double r2 = r * r;
  const double depth = stiffness * (std::pow(1.0 - r2, 2) + 4.0 * zeta * zeta * r2) / (2.0 * (r2 - 1.0)) / per_depth;
  const double helix = std::atan(std::numbers::pi * diameter / (teeth * depth));
  ASSERT_LT(helix, 80.0 * degree);
  process.cutter.helices_rad.assign(teeth, helix);
  const auto tool = relative_structure(testing::modal_model({{hz, zeta, mass, Eigen::Vector3d::UnitX()}}), "P");
  for (const int j : {1, 2}) {
    const double rpm =
        hz * r * std::numbers::pi / (j * std::numbers::pi - std::atan((r2 - 1.0) / (2.0 * zeta * r))) * 60.0 / teeth;
    EXPECT_NEAR(multiplier_at(tool, process, rpm, depth, sharp()).modulus, 1.0, 1e-9) << "lobe " << j;
  }
}

TEST(Helix, LimitingDepthIsWhereTheMultiplierCrossesOne) {
  const MillingProcess process = process_with(
      {4, 0.012, {}, {35.0 * degree, 35.0 * degree, 35.0 * degree, 35.0 * degree}}, 100.0 * degree, 180.0 * degree);
  StabilityOptions options;
  options.error_tolerance = 1e-6;
  options.depth_limit_m = 0.02;
  for (const double rpm : {4000.0, 7000.0, 8800.0}) {
    const LobeRow row = limiting_depth(structure(), process, rpm, options);
    ASSERT_EQ(row.status, StabilityStatus::converged) << rpm;
    const auto modulus = [&](double factor) {
      return multiplier_at(structure(), process, rpm, factor * row.limiting_depth_m, options).modulus;
    };
    EXPECT_NEAR(modulus(1.0), 1.0, 1e-5) << rpm;
    EXPECT_LT(modulus(0.99), 1.0);
    EXPECT_GT(modulus(1.01), 1.0);
  }
}

/// The two-DOF benchmark at a/D = 0.1 with helices.
const std::vector<testing::Mode> benchmark_modes{{922.0, 0.011, 0.03993, Eigen::Vector3d::UnitX()},
                                                 {922.0, 0.011, 0.03993, Eigen::Vector3d::UnitY()}};

MillingProcess benchmark_with(std::vector<double> helices_rad) {
  MillingProcess process;
  process.cutter = {2, 0.01, {}, std::move(helices_rad)};
  process.coefficients = {6e8, 2e8, 0.0, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, 1e-3, MillingDirection::down);
  return process;
}

/// Seven modes of a machine's range and a wide cut, several teeth at a time, at depths of a hundredth of a millimetre.
struct ShallowCut {
  std::vector<testing::Mode> modes;
  MillingProcess process;
  double rpm = 0.0;
};

ShallowCut shallow_cut(std::mt19937_64& engine) {
  const auto uniform = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(engine); };
  ShallowCut cut;
  for (int i = 0; i < 7; ++i) {
    const double angle = uniform(0.0, std::numbers::pi), hz = uniform(120.0, 2500.0);
    const double stiffness = 1e6 * std::exp(uniform(0.0, 4.0)), omega = 2.0 * std::numbers::pi * hz;
    cut.modes.push_back({hz, 0.002 * std::exp(uniform(0.0, 3.0)), stiffness / (omega * omega),
                         Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0)});
  }
  cut.process = process_with({4, 0.012, {}, std::vector<double>(4, uniform(0.2, 0.8))}, 0.0, uniform(0.4, 2.6));
  cut.rpm = uniform(1500.0, 12000.0);
  return cut;
}

TEST(Helix, ShallowCutsAreNoFurtherOffThanTheyClaim) {
  // A multiplier has its grid alone, and no derivative by the depth: it crosses one within what a depth claims.
  std::mt19937_64 engine(1);
  int found = 0;
  for (int i = 0; i < 24; ++i) {
    const ShallowCut cut = shallow_cut(engine);
    const RelativeStructure poles = relative_structure(testing::modal_model(cut.modes), "P");
    StabilityOptions options = sharp();
    options.follow = 1.0;
    const LobeRow row = limiting_depth(poles, cut.process, cut.rpm, options);
    if (row.status != StabilityStatus::converged) continue;
    ++found;
    const double away = 1e-7 + row.error_estimate;
    EXPECT_LT(multiplier_at(poles, cut.process, cut.rpm, (1.0 - away) * row.limiting_depth_m, sharp()).modulus, 1.0)
        << i << ": " << row.limiting_depth_m << " m";
    EXPECT_GT(multiplier_at(poles, cut.process, cut.rpm, (1.0 + away) * row.limiting_depth_m, sharp()).modulus, 1.0)
        << i << ": " << row.limiting_depth_m << " m";
  }
  EXPECT_GE(found, 22);
}

TEST(Helix, TheFirstCrossingIsTheSameWhateverElseIsWantedAndExpected) {
  std::mt19937_64 engine(2);
  int found = 0;
  for (int i = 0; i < 8; ++i) {
    const ShallowCut cut = shallow_cut(engine);
    const RelativeStructure poles = relative_structure(testing::modal_model(cut.modes), "P");
    const LobeRow all = limiting_depth(poles, cut.process, cut.rpm, StabilityOptions{});
    if (all.at_limit || all.status != StabilityStatus::converged) continue;
    ++found;
    for (const double follow : {1.0, 3.0}) {
      for (const double expected : {0.3, 1.0, 4.0}) {
        StabilityOptions options;
        options.follow = follow;
        options.expected_depth_m = expected * all.limiting_depth_m;
        const LobeRow row = limiting_depth(poles, cut.process, cut.rpm, options);
        EXPECT_EQ(row.status, StabilityStatus::converged) << i << ", " << follow << ", " << expected;
        EXPECT_NEAR(row.limiting_depth_m / all.limiting_depth_m, 1.0, 1e-7 + all.error_estimate + row.error_estimate)
            << i << ", " << follow << ", " << expected;
        if (follow == 1.0) {
          EXPECT_LE(row.crossings.back().depth_m, 1.11 * row.limiting_depth_m) << i << ", " << expected;
        }
      }
    }
  }
  EXPECT_GE(found, 6);
}

/// A slender tool whose flip lobe is an island, which helical edges close from above (Zatarain et al. 2006), below a
/// Hopf lobe.
RelativeStructure slender_tool() {
  const auto mode = [](double hz, double damping, double stiffness) {
    return testing::Mode{hz, damping, stiffness / std::pow(2.0 * std::numbers::pi * hz, 2), Eigen::Vector3d::UnitY()};
  };
  return relative_structure(testing::modal_model({mode(1031.6, 0.034, 7.86e6), mode(520.9, 0.019, 1.127e6)}), "P");
}

MillingProcess slender_cut() {
  MillingProcess process = process_with({4, 0.01, {}, std::vector<double>(4, 45.0 * degree)}, 0.0, 0.0);
  process.engagement = engagement_of(process.cutter, 0.1e-3, MillingDirection::down);
  process.coefficients = {6e8, 3e8};
  return process;
}

TEST(Helix, AStableRangeFarAboveTheFirstCrossingIsFound) {
  const RelativeStructure tool = slender_tool();
  const MillingProcess process = slender_cut();
  StabilityOptions options;
  options.depth_limit_m = 0.04;
  options.follow = 60.0;
  for (const double rpm : {16150.0, 17080.0}) {
    const LobeRow row = limiting_depth(tool, process, rpm, options);
    ASSERT_EQ(row.status, StabilityStatus::converged) << rpm;
    ASSERT_GE(row.crossings.size(), 3u) << rpm;
    const double leaves = row.crossings[0].depth_m, returns = row.crossings[1].depth_m,
                 leaves_again = row.crossings[2].depth_m;
    EXPECT_GT(returns, 3.0 * leaves) << rpm;
    const auto modulus = [&](double depth_m) { return multiplier_at(tool, process, rpm, depth_m, options).modulus; };
    for (const double share : {0.01, 0.5, 0.99}) {
      EXPECT_GT(modulus(leaves + share * (returns - leaves)), 1.0) << rpm;
      EXPECT_LT(modulus(returns + share * (leaves_again - returns)), 1.0) << rpm;
    }
  }
}

TEST(Helix, DeepCrossingsAboveWhichTheCutIsNowhereStableAgainAreLeftOut) {
  const RelativeStructure tool = slender_tool();
  const MillingProcess process = slender_cut();
  StabilityOptions options;
  options.depth_limit_m = 0.04;
  int rows = 0;
  for (const double rpm : {6000.0, 7000.0, 9000.0, 13000.0}) {
    const LobeRow row = limiting_depth(tool, process, rpm, options);
    ASSERT_EQ(row.status, StabilityStatus::converged) << rpm;
    if (row.at_limit || row.crossings.back().unstable_change < 0) continue;
    ++rows;
    const double to_m = std::min(options.depth_limit_m, options.follow * row.limiting_depth_m);
    EXPECT_NEAR(row.searched_m / to_m, 1.0, 1e-3) << rpm;
    EXPECT_LE(row.crossings.back().depth_m, 2.01 * row.limiting_depth_m) << rpm;
    for (double depth_m = 1.01 * row.crossings.back().depth_m; depth_m < to_m; depth_m *= 1.1)
      EXPECT_GT(multiplier_at(tool, process, rpm, depth_m, options).modulus, 1.0) << rpm << " rpm, " << depth_m << " m";
  }
  EXPECT_GE(rows, 2);
}

/// With a wide cut a first step of the search goes to 1.3 mm, where this cut chatters at a twentieth of it: all
/// crossings up to there took minutes on the grids of a part.
TEST(Helix, AFirstCrossingFarBelowTheFirstStepIsTheSameWhateverIsExpected) {
  const RelativeStructure tool = slender_tool();
  MillingProcess process = slender_cut();
  process.engagement = engagement_of(process.cutter, 8e-3, MillingDirection::down);
  process.coefficients = {3e9, 1.5e9};
  for (const double rpm : {2000.0, 5000.0}) {
    StabilityOptions options;
    const LobeRow row = limiting_depth(tool, process, rpm, options);
    ASSERT_EQ(row.status, StabilityStatus::converged) << rpm;
    EXPECT_LT(row.limiting_depth_m, 0.1e-3) << rpm;
    for (const double expected : {0.2, 1.0, 3.0}) {
      options.expected_depth_m = expected * row.limiting_depth_m;
      const LobeRow other = limiting_depth(tool, process, rpm, options);
      EXPECT_NEAR(other.limiting_depth_m / row.limiting_depth_m, 1.0, 1e-7 + row.error_estimate + other.error_estimate)
          << rpm << " rpm, expected " << expected;
    }
  }
}

TEST(Helix, SearchesUpToTheEndOfTheEdgesAndNotBeyond) {
  // At 7205.5 rpm a crossing lies at 10.01 mm, just beyond the edges.
  const RelativeStructure tool = relative_structure(testing::modal_model(benchmark_modes), "P");
  MillingProcess process = benchmark_with({30.0 * degree, 30.0 * degree});
  StabilityOptions options;
  options.depth_limit_m = 0.01;
  for (const double rpm : {7205.514, 7210.0, 9210.0}) {
    process.cutter.envelope.height_m = 0.02;
    const LobeRow longer = limiting_depth(tool, process, rpm, options);
    process.cutter.envelope.height_m = options.depth_limit_m;
    const LobeRow row = limiting_depth(tool, process, rpm, options);
    EXPECT_EQ(row.status, StabilityStatus::converged) << rpm;
    EXPECT_EQ(row.crossings.size(), longer.crossings.size()) << rpm;
    EXPECT_NEAR(row.limiting_depth_m / longer.limiting_depth_m, 1.0, 2e-4) << rpm;
  }
}

TEST(StraightEdges, MayEndJustBelowOrAboveACrossing) {
  const RelativeStructure tool = relative_structure(testing::modal_model(benchmark_modes), "P");
  MillingProcess process = benchmark_with({});
  StabilityOptions options;
  for (const double rpm : {5000.0, 7205.514, 9210.0}) {
    process.cutter.envelope.height_m = 0.04;
    options.depth_limit_m = 0.04;
    const double depth_m = limiting_depth(tool, process, rpm, options).limiting_depth_m;
    ASSERT_LT(depth_m, 0.03) << rpm;
    for (const double part : {0.96, 0.99, 0.999, 1.001, 1.01}) {
      process.cutter.envelope.height_m = options.depth_limit_m = part * depth_m;
      const LobeRow row = limiting_depth(tool, process, rpm, options);
      EXPECT_EQ(row.at_limit, part < 1.0) << rpm << " rpm, edges of " << part << " times the depth";
      EXPECT_NEAR(row.limiting_depth_m / depth_m, std::min(part, 1.0), 1e-4) << rpm;
      EXPECT_LE(row.searched_m, options.depth_limit_m);
    }
  }
}

TEST(Helix, CrossingsThatAppearWithTheShapeOfTheCutAreFound) {
  // Frozen at any depth up to 5.4 mm the cut has no crossing near the one that the true cut has there (two flips appear
  // together as the shape changes); the second row ends in a range that such a crossing makes unstable.
  const RelativeStructure tool = relative_structure(testing::modal_model(benchmark_modes), "P");
  MillingProcess process = benchmark_with({30.0 * degree, 40.0 * degree});
  process.cutter.envelope.height_m = 0.012;
  StabilityOptions options;
  options.depth_limit_m = 0.01;
  options.follow = 1.0;
  for (const double rpm : {6818.182, 14090.909}) {
    const LobeRow row = limiting_depth(tool, process, rpm, options);
    ASSERT_EQ(row.status, StabilityStatus::converged) << rpm;
    const auto modulus = [&](double factor) {
      return multiplier_at(tool, process, rpm, factor * row.limiting_depth_m, options).modulus;
    };
    EXPECT_LT(modulus(0.999), 1.0) << rpm;
    EXPECT_GT(modulus(1.001), 1.0) << rpm;
    for (const double factor : {0.3, 0.6, 0.9}) EXPECT_LT(modulus(factor), 1.0) << rpm;
  }
}

TEST(Helix, ModesThatTheTeethDoNotFeelHideNoCrossing) {
  // Eight sharp modes along the axis, whose multipliers lie nearer to the circle than those that cross it.
  std::vector<testing::Mode> felt{{600.0, 0.02, 0.1407, Eigen::Vector3d::UnitX()},
                                  {680.0, 0.02, 0.12, Eigen::Vector3d::UnitY()},
                                  {790.0, 0.02, 0.1, Eigen::Vector3d::UnitY()},
                                  {950.0, 0.02, 0.0842, Eigen::Vector3d::UnitY()}};
  const RelativeStructure plain = relative_structure(testing::modal_model(felt), "P");
  for (int i = 0; i < 8; ++i) felt.push_back({300.0 + 70.0 * i, 5e-4, 1.0, Eigen::Vector3d::UnitZ()});
  const RelativeStructure with_axial = relative_structure(testing::modal_model(felt), "P");
  MillingProcess process = process_with({4, 0.012, {}, std::vector<double>(4, 30.0 * degree)}, 0.0, 0.0);
  process.engagement = engagement_of(process.cutter, 2e-3, MillingDirection::down);
  StabilityOptions options;
  options.depth_limit_m = 0.02;
  std::size_t beyond_first = 0;
  for (const double rpm : {2000.0, 3000.0, 4000.0, 5000.0, 6500.0, 8000.0, 11000.0}) {
    const LobeRow expected = limiting_depth(plain, process, rpm, options);
    const LobeRow row = limiting_depth(with_axial, process, rpm, options);
    EXPECT_NEAR(row.searched_m, expected.searched_m, 1e-9) << rpm;
    ASSERT_EQ(row.crossings.size(), expected.crossings.size()) << rpm;
    beyond_first += row.crossings.size() - 1;
    for (std::size_t i = 0; i < row.crossings.size(); ++i)
      EXPECT_NEAR(row.crossings[i].depth_m / expected.crossings[i].depth_m, 1.0, 1e-6) << rpm;
  }
  EXPECT_GE(beyond_first, 4u);
}

TEST(Cutter, RefusesPitchesThatAreNoTurnAndHelicesTooSteep) {
  EXPECT_EQ(validate(Cutter{2, 0.01, {1.0, 2.0}}).size(), 1u);
  EXPECT_EQ(validate(Cutter{2, 0.01, {-1.0, 1.0 + 2.0 * std::numbers::pi}}).size(), 1u);
  EXPECT_EQ(validate(Cutter{2, 0.01, {std::numbers::pi, 0.5 * std::numbers::pi, 0.5 * std::numbers::pi}}).size(), 1u);
  EXPECT_EQ(validate(Cutter{2, 0.01, {}, {90.0 * degree, 90.0 * degree}}).size(), 2u);
  EXPECT_EQ(validate(Cutter{2, 0.01, {}, {0.5}}).size(), 1u);
  EXPECT_TRUE(validate(Cutter{2, 0.01, {3.0, 2.0 * std::numbers::pi - 3.0}, {0.5, 0.6}}).empty());
}

}  // namespace
}  // namespace thinwall::milling::helix_and_pitch_test

// Rows from lines that are stable up to the depth limit: what the lines leave open of the first crossing beyond is in
// their estimate.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "flip_lobes.hpp"
#include "milling/chart/near_crossing.hpp"
#include "milling/chart/sampled_stability.hpp"
#include "milling/direct/cut_at_speed.hpp"

namespace thinwall::milling::row_at_limit_test {
namespace {

using testing::Draws;
using testing::first_only;
using testing::FlipLobes;
using testing::lines_of;

/// Of eighteen rows of noisy lines, whose depth limits lie some estimates below the first crossing, those that are
/// called stable. The edges go on, or end at the depth limit, as by default those of a case do.
int stable_below_crossing(const FlipLobes& lobes, double estimates, bool edges_end = false) {
  Draws draw(9);
  int stable = 0;
  for (int i = 0; i < 6; ++i) {
    const FittedStructure fit = lobes.fit(0.003, draw);
    for (const double rpm : {9400.0, 11000.0, 12200.0}) {
      const LobeRow deep = limiting_depth(fit, lobes.process, rpm, first_only());
      StabilityOptions options = first_only();
      options.depth_limit_m = deep.limiting_depth_m * (1.0 - estimates * deep.error_estimate);
      MillingProcess process = lobes.process;
      if (edges_end) process.cutter.envelope.height_m = options.depth_limit_m;
      const LobeRow row = limiting_depth(fit, process, rpm, options);
      EXPECT_TRUE(row.at_limit);
      stable += row.status == StabilityStatus::stable_to_depth_limit ? 1 : 0;
      // Else the row reaches down to where the crossing may lie.
      if (row.status != StabilityStatus::stable_to_depth_limit) {
        EXPECT_LE(options.depth_limit_m * (1.0 - row.error_estimate),
                  deep.limiting_depth_m * (1.0 - 0.99 * deep.error_estimate));
      }
    }
  }
  return stable;
}

// A crossing that lies beyond the depth limit by less than the lines leave open may lie below it, whatever |μ| is
// there.
TEST(RowAtLimit, ARowIsStableToADepthLimitOnlyIfItsFirstCrossingBeyondLiesClearlyDeeper) {
  const FlipLobes lobes;
  EXPECT_EQ(stable_below_crossing(lobes, 0.5), 0);
  EXPECT_EQ(stable_below_crossing(lobes, 2.0), 18);
}

TEST(RowAtLimit, ARowIsStableToTheHeightOfTheEdgesOnlyIfACrossingOfLongerOnesWouldLieClearlyDeeper) {
  const FlipLobes lobes;
  EXPECT_EQ(stable_below_crossing(lobes, 0.5, true), 0);
  EXPECT_EQ(stable_below_crossing(lobes, 2.0, true), 18);
}

/// A structure of which the odd lines say that it is a tenth more compliant: its first crossing is at 1/1.1 of the
/// depth, and by twice the change it may lie 0.18 below.
struct OddLines {
  static constexpr double rpm = 11000.0, more_compliant = 1.1;
  FlipLobes lobes;
  FittedStructure fit = fitted_structure({lines_of(lobes.poles, 200.0, 8000.0, 10.0), {}}, lobes.process.frame);
  double first_m = lobes.row(rpm).limiting_depth_m;
  double reached_m = first_m * (1.0 - 2.0 * (1.0 - 1.0 / more_compliant));
  StabilityOptions options = first_only();

  OddLines() {
    fit.odd.poles.phi *= more_compliant;
    fit.odd.poles.R *= more_compliant;
  }
  /// The row up to a depth, which has no crossing.
  [[nodiscard]] LobeRow row_up_to(double limit_m) {
    options.depth_limit_m = limit_m;
    LobeRow row = limiting_depth(fit, lobes.process, rpm, options);
    EXPECT_TRUE(row.at_limit);
    return row;
  }
};

TEST(RowAtLimit, ARowAtTheDepthLimitIsOpenByTwiceTheChangeOfItsFirstCrossingByEverySecondLine) {
  OddLines lines;
  for (const double limit : {0.97, 0.86, 0.75}) {  // of the first crossing
    const double limit_m = limit * lines.first_m;
    const LobeRow row = lines.row_up_to(limit_m);
    if (limit_m < lines.reached_m) {
      EXPECT_EQ(row.status, StabilityStatus::stable_to_depth_limit);
    } else {
      EXPECT_NE(row.status, StabilityStatus::stable_to_depth_limit);
      EXPECT_NEAR(row.error_estimate, 1.0 - lines.reached_m / limit_m, 1e-3) << "the rows' own tolerance";
    }
  }
}

TEST(RowAtLimit, ARowAtTheDepthLimitThatIsOpenByLessThanTheToleranceIsStable) {
  OddLines lines;
  lines.options.error_tolerance = 0.05;
  const LobeRow row = lines.row_up_to(lines.reached_m / (1.0 - 0.02));
  EXPECT_EQ(row.status, StabilityStatus::stable_to_depth_limit);
  EXPECT_NEAR(row.error_estimate, 0.02, 0.01) << "a fifth of the rows' own tolerance";
}

TEST(RowAtLimit, ARowAtTheDepthLimitWithoutEnoughNodesHasWhatTheLinesLeaveOpenInItsEstimate) {
  OddLines lines;
  lines.options.most_nodes = 8;
  const double limit_m = 0.97 * lines.first_m;
  const LobeRow row = lines.row_up_to(limit_m);
  EXPECT_EQ(row.status, StabilityStatus::node_limit_reached);
  EXPECT_GT(row.error_estimate, 0.9 * (1.0 - lines.reached_m / limit_m));
}

/// A structure without noise whose modes within the lines are a fifth more compliant. Their crossing is at five sixths
/// of the depth, and is lost when the first one is followed to it, which makes an estimate of 1.
struct LostCrossing {
  static constexpr double rpm = 11000.0, more_compliant = 1.2;
  FlipLobes lobes;
  FittedStructure fit = fitted_structure({lines_of(lobes.poles, 200.0, 8000.0, 10.0), {}}, lobes.process.frame);
  double first_m = lobes.row(rpm).limiting_depth_m, within_m = first_m / more_compliant;

  LostCrossing() {
    fit.within.poles.phi *= more_compliant;
    fit.within.poles.R *= more_compliant;
  }
  /// The row up to a depth, which has no crossing.
  [[nodiscard]] LobeRow row_up_to(double limit_m) const {
    StabilityOptions options = first_only();
    options.depth_limit_m = limit_m;
    LobeRow row = limiting_depth(fit, lobes.process, rpm, options);
    EXPECT_TRUE(row.at_limit);
    return row;
  }
};

TEST(RowAtLimit, ACrossingThatIsLostOnTheWayToAnotherFitDoesNotOpenARowBelowTheCrossingsOfAllFits) {
  const LostCrossing lines;
  LobePoint first = limiting_depth(lines.fit.all.poles, lines.lobes.process, lines.rpm, first_only()).crossings.at(0);
  follow_to_lines(lines.fit, cut_at_speed(lines.fit.all.poles, lines.lobes.process, lines.rpm), first);
  ASSERT_GE(first.error_estimate, 1.0);
  EXPECT_EQ(lines.row_up_to(0.9 * lines.within_m).status, StabilityStatus::stable_to_depth_limit);
}

TEST(RowAtLimit, WhereACrossingIsLostTheRowOfTheModesWithinTheLinesTells) {
  const LostCrossing lines;
  const double limit_m = 0.9 * lines.first_m;
  const LobeRow row = lines.row_up_to(limit_m);
  EXPECT_NE(row.status, StabilityStatus::stable_to_depth_limit);
  EXPECT_NEAR(row.error_estimate, 1.0 - lines.within_m / limit_m, 1e-3) << "the rows' own tolerance";
}

// Modes above the lines that may be larger by orders than those within are in no row of a fit.
TEST(RowAtLimit, WhereACrossingIsLostModesAboveTheLinesStillOpenTheRow) {
  LostCrossing lines;
  lines.fit.unseen.setIdentity();  // m/N
  EXPECT_EQ(lines.row_up_to(0.9 * lines.within_m).status, StabilityStatus::data_insufficient);
}

// A pole that grows adds unstable multipliers that belong to no crossing.
TEST(RowAtLimit, ARowAtTheDepthLimitIsNoAnswerWhereEverySecondLineGivesNoRow) {
  OddLines lines;
  for (std::complex<double>& pole : lines.fit.odd.poles.poles) pole = -std::conj(pole);
  const LobeRow row = lines.row_up_to(0.5 * lines.first_m);
  EXPECT_EQ(row.status, StabilityStatus::data_insufficient);
  EXPECT_GE(row.error_estimate, 1.0);
}

// Edges of a thin cutter that end in a point a little above the depth limit cannot go on, and |μ| at the limit tells.
TEST(RowAtLimit, ARowOfEdgesThatCannotGoOnIsComparedByItsMultiplier) {
  OddLines lines;
  Cutter& cutter = lines.lobes.process.cutter;
  cutter.diameter_m = 0.001;
  const auto up_to = [&](double limit_m) {
    cutter.envelope.height_m = limit_m;
    cutter.envelope.taper_rad = -std::atan(0.5 * cutter.diameter_m / (1.1 * limit_m));
    return lines.row_up_to(limit_m).status;
  };
  EXPECT_EQ(up_to(0.4 * lines.first_m), StabilityStatus::stable_to_depth_limit);
  EXPECT_EQ(up_to(0.9 * lines.first_m), StabilityStatus::data_insufficient);
}

}  // namespace
}  // namespace thinwall::milling::row_at_limit_test

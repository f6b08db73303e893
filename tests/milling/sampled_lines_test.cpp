// Lobes from lines of random structures: no depth may be further from that of the poles than the row says, whatever the
// spacing, range and noise of the lines.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "flip_lobes.hpp"
#include "milling/chart/near_crossing.hpp"
#include "milling/chart/sampled_stability.hpp"
#include "milling/direct/stability.hpp"
#include "single_mode.hpp"

namespace thinwall::milling::sampled_lines_test {
namespace {

using testing::add_noise;
using testing::Draws;
using testing::first_only;
using testing::FlipLobes;
using testing::lines_of;

/// With THINWALL_SLOW=1 in the environment there are ten times as many structures.
const int structures = std::getenv("THINWALL_SLOW") != nullptr ? 2000 : 200;

struct Structure {
  RelativeStructure poles;
  double lowest_hz = 1e9, highest_hz = 0.0;
  double half_width_hz = 1e9;  ///< of the sharpest mode
};

/// One to five modes in the plane of the cut, ζ from 0.3 to 5 %.
Structure random_structure(Draws& draw) {
  std::vector<testing::Mode> modes(static_cast<std::size_t>(draw.uniform(1.0, 6.0)));
  Structure result;
  for (testing::Mode& mode : modes) {
    const double angle = draw.uniform(0.0, std::numbers::pi);
    const double hz = draw.uniform(150.0, 1200.0), damping = draw.logarithmic(0.003, 0.05);
    mode = {hz, damping, draw.logarithmic(0.2, 5.0), Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0)};
    result.lowest_hz = std::min(result.lowest_hz, hz);
    result.highest_hz = std::max(result.highest_hz, hz);
    result.half_width_hz = std::min(result.half_width_hz, damping * hz);
  }
  result.poles = relative_structure(testing::modal_model(modes), "P");
  return result;
}

MillingProcess random_cut(Draws& draw) {
  MillingProcess process;
  process.cutter = {static_cast<int>(draw.uniform(1.0, 5.0)), 0.012};
  process.coefficients = {draw.logarithmic(3e8, 3e9), draw.logarithmic(1e8, 1e9)};
  process.engagement = engagement_of(process.cutter, draw.uniform(5e-4, 0.012),
                                     draw.uniform(0.0, 1.0) < 0.5 ? MillingDirection::up : MillingDirection::down);
  return process;
}

/// Counts of rows by error and estimate.
struct Tally {
  int rows = 0, beyond = 0;
  double worst = 0.0;  ///< largest error over estimate
  std::vector<double> estimates;

  void add(const LobeRow& found, const LobeRow& exact) {
    if (exact.at_limit || found.at_limit || found.status == StabilityStatus::crossing_missed) return;
    const double error = std::abs(found.limiting_depth_m / exact.limiting_depth_m - 1.0);
    const double ratio = error / (found.error_estimate + exact.error_estimate);
    ++rows;
    beyond += ratio > 1.0 ? 1 : 0;
    worst = std::max(worst, ratio);
    estimates.push_back(found.error_estimate);
  }
  [[nodiscard]] double median_estimate() {
    std::ranges::nth_element(estimates, estimates.begin() + static_cast<long>(estimates.size() / 2));
    return estimates[estimates.size() / 2];
  }
  void print(const char* what) {
    std::printf("%s: %d rows, %d beyond, worst %.2f, median estimate %.1e\n", what, rows, beyond, worst,
                median_estimate());
  }
};

/// Adds the row of lines against that of the poles. Lines are refused where a tooth passing lies beyond them, or where
/// a few of them show no resonance.
void compare(const SampledReceptance& lines, const RelativeStructure& poles, const MillingProcess& process, double rpm,
             Tally& tally) {
  try {
    tally.add(limiting_depth(SampledStructure{lines, {}}, process, rpm, first_only()),
              limiting_depth(poles, process, rpm, first_only()));
  } catch (const core::InputError&) {
  }
}

TEST(SampledLines, NoDepthIsFurtherOffThanClaimedWhateverTheSpacing) {
  Draws draw(1);
  Tally tally;
  for (int i = 0; i < structures; ++i) {
    const Structure structure = random_structure(draw);
    const MillingProcess process = random_cut(draw);
    const double rpm = draw.uniform(2000.0, 15000.0);
    const SampledReceptance lines = lines_of(structure.poles, 0.3 * structure.lowest_hz, 3.0 * structure.highest_hz,
                                             draw.logarithmic(0.1, 3.0) * structure.half_width_hz);
    compare(lines, structure.poles, process, rpm, tally);
  }
  tally.print("spacing");
  EXPECT_GE(tally.rows, structures / 2);
  EXPECT_EQ(tally.beyond, 0);
}

TEST(SampledLines, NoDepthIsFurtherOffThanClaimedWhereTheBandEndsEarly) {
  Draws draw(2);
  Tally tally;
  for (int i = 0; i < structures; ++i) {
    const Structure structure = random_structure(draw);
    const MillingProcess process = random_cut(draw);
    const double rpm = draw.uniform(2000.0, 15000.0);
    const SampledReceptance lines =
        lines_of(structure.poles, draw.uniform(0.05, 0.9) * structure.lowest_hz,
                 draw.uniform(0.6, 1.5) * structure.highest_hz, draw.logarithmic(0.1, 1.0) * structure.half_width_hz);
    compare(lines, structure.poles, process, rpm, tally);
  }
  tally.print("range");
  EXPECT_GE(tally.rows, structures / 4);
  EXPECT_EQ(tally.beyond, 0);
}

/// Twenty to forty modes at equal distances but for a fifth, as of a plate, up to four times the end of the lines.
Structure random_plate(Draws& draw, double last_hz) {
  std::vector<testing::Mode> modes(static_cast<std::size_t>(draw.uniform(20.0, 41.0)));
  const double spacing_hz = 4.0 * last_hz / static_cast<double>(modes.size()), damping = draw.logarithmic(0.005, 0.02);
  Structure result;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const double angle = draw.uniform(0.0, std::numbers::pi);
    const double hz = (static_cast<double>(i + 1) + draw.uniform(-0.2, 0.2)) * spacing_hz;
    modes[i] = {hz, damping, draw.logarithmic(0.5, 2.0), Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0)};
    result.lowest_hz = std::min(result.lowest_hz, hz);
    result.half_width_hz = std::min(result.half_width_hz, damping * hz);
  }
  result.poles = relative_structure(testing::modal_model(modes), "P");
  return result;
}

/// A plate of which the lines end below half of its modes, a cut and a speed.
struct PlateBeyondLines {
  Structure structure;
  MillingProcess process;
  double rpm = 0.0, last_hz = 0.0;

  explicit PlateBeyondLines(Draws& draw) : last_hz(draw.logarithmic(1000.0, 4000.0)) {
    structure = random_plate(draw, last_hz);
    process = random_cut(draw);
    rpm = draw.uniform(2000.0, 15000.0);
  }
  void compare(Tally& tally) const {
    const SampledReceptance lines =
        lines_of(structure.poles, 0.3 * structure.lowest_hz, last_hz, 0.5 * structure.half_width_hz);
    sampled_lines_test::compare(lines, structure.poles, process, rpm, tally);
  }
};

TEST(SampledLines, NoDepthIsFurtherOffThanClaimedWhereManyModesLieAboveTheLines) {
  Draws draw(4);
  Tally tally;
  for (int i = 0; i < structures / 8; ++i) PlateBeyondLines(draw).compare(tally);
  tally.print("modes above");
  EXPECT_GE(tally.rows, structures / 16);
  EXPECT_EQ(tally.beyond, 0);
}

// All fits of this plate have a pole at 6800 Hz that no mode has, above twice the last line, and a crossing with it a
// quarter below the true limit.
TEST(SampledLines, ACrossingAtAPoleFarAboveTheLinesDependsOnWhatTheFitsSayThere) {
  Draws draw(4);
  for (int i = 0; i < 41; ++i) (void)PlateBeyondLines(draw);
  Tally tally;
  PlateBeyondLines(draw).compare(tally);
  EXPECT_EQ(tally.rows, 1);
  EXPECT_EQ(tally.beyond, 0);
}

/// Noisy lines of a structure, a cut and a speed. Ten fits more than without noise take their time by the number of
/// lines; fewer of them average less of it out.
struct NoisyLines {
  Structure structure;
  MillingProcess process;
  double rpm = 0.0;
  SampledReceptance lines;

  explicit NoisyLines(Draws& draw) : structure(random_structure(draw)), process(random_cut(draw)) {
    constexpr Eigen::Index most_lines = 600;
    rpm = draw.uniform(2000.0, 15000.0);
    lines = lines_of(structure.poles, 0.3 * structure.lowest_hz, 3.0 * structure.highest_hz,
                     draw.logarithmic(0.1, 1.0) * structure.half_width_hz, most_lines);
    const double noise = draw.logarithmic(1e-4, 3e-2);
    add_noise(lines, noise, draw);
  }
  void compare(Tally& tally) const { sampled_lines_test::compare(lines, structure.poles, process, rpm, tally); }
};

TEST(SampledLines, NoiseIsInTheEstimate) {
  Draws draw(3);
  Tally tally;
  for (int i = 0; i < structures; ++i) NoisyLines(draw).compare(tally);
  tally.print("noise");
  EXPECT_GE(tally.rows, structures / 2);
  // Five standard deviations from the scatter of ten fits: Student's t of nine degrees of freedom is beyond 5 in 7.4e-4
  // of the rows, which is none of 200 as a rule and 1.5 of 2000, seven or more of them once in a thousand times.
  EXPECT_LE(tally.beyond, structures > 200 ? 6 : 0);
  EXPECT_LT(tally.worst, 2.0);
}

// Structure 204 has a lobe a hundredth deeper than the first that is less certain. Structure 776 has another first lobe
// by the lines than by the poles of their fit.
TEST(SampledLines, ALobeThatMayBeFirstIsFollowedToTheLines) {
  Draws draw(3);
  Tally tally;
  for (int i = 0; i <= 776; ++i) {
    const NoisyLines noisy(draw);
    if (i == 204 || i == 776) noisy.compare(tally);
  }
  EXPECT_EQ(tally.rows, 2);
  EXPECT_EQ(tally.beyond, 0);
}

/// Between each two of these speeds there is one nose.
constexpr std::pair<double, double> noses[] = {{9080.0, 9140.0}, {9160.0, 9240.0}, {12700.0, 12820.0}};

// Beside the nose the lines say on which side of it a speed is only so far: the row has the other lobe's depth, which
// is 40 to 70 % off, or must have it in its estimate. Three hundredths of the speed away it has not.
TEST(SampledLines, BesideTheNoseOfAFlipLobeTheOtherLobeIsInTheEstimate) {
  const FlipLobes lobes;
  Draws draw(5);
  Tally beside, away;
  for (int i = 0; i < 3; ++i) {
    const FittedStructure fit = lobes.fit(0.003, draw);
    const auto add = [&](double rpm, Tally& tally) {
      tally.add(limiting_depth(fit, lobes.process, rpm, first_only()), lobes.row(rpm));
    };
    for (const auto& [from, to] : noses) {
      const double nose = lobes.nose_rpm(from, to);
      for (const double off : {-3e-3, -1e-3, -1e-4, -1e-5, 1e-5, 1e-4, 1e-3, 3e-3}) add(nose * (1.0 + off), beside);
      for (const double off : {-0.03, 0.03}) add(nose * (1.0 + off), away);
    }
  }
  beside.print("beside a nose");
  away.print("away from it");
  EXPECT_EQ(beside.rows, 72);
  EXPECT_EQ(beside.beyond, 0);
  EXPECT_EQ(away.beyond, 0);
  EXPECT_LT(away.median_estimate(), 0.1);
}

// With the crossings beyond the first, as a chart has them, the estimate is the distance to the other lobe and not all.
TEST(SampledLines, BesideTheNoseOfAFlipLobeTheEstimateReachesHardlyFurtherThanToTheOtherLobe) {
  const FlipLobes lobes;
  Draws draw(6);
  const FittedStructure fit = lobes.fit(0.003, draw);
  StabilityOptions options;
  options.depth_limit_m = 0.2;
  for (const auto& [from, to] : noses) {
    const double nose = lobes.nose_rpm(from, to);
    const double one_m = lobes.row(nose * (1.0 - 3e-4)).limiting_depth_m;
    const double other_m = lobes.row(nose * (1.0 + 3e-4)).limiting_depth_m;
    const double distance = std::max(one_m, other_m) / std::min(one_m, other_m) - 1.0;
    for (const double off : {-1e-4, -1e-5, 1e-5, 1e-4}) {
      SCOPED_TRACE(std::to_string(nose) + " rpm, " + std::to_string(off));
      const LobeRow found = limiting_depth(fit, lobes.process, nose * (1.0 + off), options);
      const double exact_m = lobes.row(nose * (1.0 + off)).limiting_depth_m;
      EXPECT_LE(std::abs(found.limiting_depth_m / exact_m - 1.0), found.error_estimate);
      // The change by the lines comes to the distance, and what the row had before.
      EXPECT_LT(found.error_estimate, 2.0 * distance + 0.1);
    }
  }
}

/// A row as of a Hopf crossing at some share of the depth of the nose, at a speed a hair off the flip lobe.
LobeRow row_at_nose(const FlipLobes& lobes, double share) {
  const double nose = lobes.nose_rpm(noses[0].first, noses[0].second);
  const LobeRow sides[] = {lobes.row(nose * (1.0 - 1e-5)), lobes.row(nose * (1.0 + 1e-5))};
  const bool flip_first = sides[0].kind == Bifurcation::flip;
  LobeRow row;
  row.spindle_speed_rpm = sides[flip_first ? 1 : 0].spindle_speed_rpm;
  row.limiting_depth_m = share * sides[flip_first ? 0 : 1].limiting_depth_m;
  row.kind = Bifurcation::hopf;
  row.error_estimate = 1e-3;
  row.status = StabilityStatus::converged;
  return row;
}

TEST(SampledLines, ANoseJustAboveTheLimitThatTheLinesMayPutBelowItIsInTheEstimate) {
  const FlipLobes lobes;
  Draws draw(7);
  const FittedStructure fit = lobes.fit(0.03, draw);
  LobeRow above = row_at_nose(lobes, 0.92), far_above = row_at_nose(lobes, 0.5);
  widen_for_near_crossings(fit, lobes.process, first_only(), above);
  widen_for_near_crossings(fit, lobes.process, first_only(), far_above);
  EXPECT_GT(above.error_estimate, 0.02);
  EXPECT_LT(above.error_estimate, 0.5);
  EXPECT_EQ(far_above.error_estimate, 1e-3);
}

TEST(SampledLines, ARowAtTheDepthLimitIsNoAnswerBesideANoseThoughItsEstimateOfTheMultiplierIsLarge) {
  const FlipLobes lobes;
  Draws draw(7);
  LobeRow row = row_at_nose(lobes, 1.3);
  row.at_limit = true;
  row.status = StabilityStatus::stable_to_depth_limit;
  row.error_estimate = 1.5;
  widen_for_near_crossings(lobes.fit(0.003, draw), lobes.process, first_only(), row);
  EXPECT_EQ(row.status, StabilityStatus::data_insufficient);
}

TEST(SampledLines, AFlipWhoseEigenvaluesHaveMetOnTheGridLeavesAllOpen) {
  const FlipLobes lobes;
  Draws draw(7);
  LobeRow row = row_at_nose(lobes, 0.9);
  row.kind = Bifurcation::flip;
  widen_for_near_crossings(lobes.fit(0.003, draw), lobes.process, first_only(), row);
  EXPECT_GE(row.error_estimate, 1.0);
}

TEST(SampledLines, BesideANoseAFitThatGivesNoNumberLeavesAllOpen) {
  const FlipLobes lobes;
  Draws draw(8);
  FittedStructure fit = lobes.fit(0.003, draw);
  ASSERT_FALSE(fit.without.empty());
  fit.without.front().poles.R.setConstant(NAN);
  LobeRow row = row_at_nose(lobes, 1.3);
  widen_for_near_crossings(fit, lobes.process, first_only(), row);
  EXPECT_GE(row.error_estimate, 1.0);
  EXPECT_EQ(row.status, StabilityStatus::data_insufficient);
}

}  // namespace
}  // namespace thinwall::milling::sampled_lines_test

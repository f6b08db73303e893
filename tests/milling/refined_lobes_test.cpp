// The line of a chart against boundaries in closed form, and what decides where speeds are added to it.

#include "milling/chart/refined_lobes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <map>
#include <mutex>
#include <vector>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "milling/chart/line_error.hpp"
#include "milling/direct/stability.hpp"
#include "tests/milling/benchmark.hpp"
#include "tests/milling/drawn_line.hpp"

namespace thinwall::milling::refined_lobes_test {
namespace {

using testing::distances;
using testing::line_at;

constexpr double step_rpm = 7654.321;

/// A boundary in closed form: lobes k = 1 … 30 of two teeth, each least at n_k = 18000/k rpm and steeper the higher k,
/// the lowest of them counts; half as deep again above step_rpm; up to a depth limit of 20 mm.
LobeRow row_in_closed_form(double rpm, const StabilityOptions& options) {
  LobeRow row;
  row.spindle_speed_rpm = rpm;
  row.limiting_depth_m = HUGE_VAL;
  for (int k = 1; k <= 30; ++k) {
    const double u = k * std::log(rpm * k / 18000.0);
    const double depth = 1e-3 * (std::cosh(9.0 * u) + 0.3 * k) * (rpm > step_rpm ? 1.5 : 1.0);
    if (depth >= row.limiting_depth_m) continue;
    row.limiting_depth_m = depth;
    row.chatter_frequency_hz = (k + 0.5 + 0.2 * std::tanh(u)) * rpm / 30.0;
  }
  row.at_limit = row.limiting_depth_m >= options.depth_limit_m;
  if (row.at_limit) row.modulus_at_limit = options.depth_limit_m / row.limiting_depth_m;
  row.limiting_depth_m = std::min(row.limiting_depth_m, options.depth_limit_m);
  row.status = row.at_limit ? StabilityStatus::stable_to_depth_limit : StabilityStatus::converged;
  return row;
}

MillingProcess two_teeth() {
  MillingProcess process;
  process.cutter = {2, 0.01};
  return process;
}

Lobes even_chart(double from_rpm, double to_rpm, int count, const RowAt& row_at, const StabilityOptions& options) {
  std::vector<LobeRow> rows;
  for (const double rpm : spindle_speeds(from_rpm, to_rpm, count)) rows.push_back(row_at(rpm, options));
  return lobes_of(std::move(rows), "test");
}

Lobes closed_form_chart(const LineOptions& line, const std::vector<double>& asked = {}, const KeptRows& kept = {}) {
  const StabilityOptions options;
  return refined(even_chart(3000.0, 18000.0, 40, row_in_closed_form, options), row_in_closed_form, two_teeth(), options,
                 line, asked, kept);
}

double worst_of_closed_form(const Lobes& chart) {
  std::vector<double> rpm = spindle_speeds(3000.001, 17999.999, 100000);
  std::erase_if(rpm, [](double n) { return std::abs(n - step_rpm) < 2e-5 * step_rpm; });
  return std::ranges::max(distances(chart, row_in_closed_form, {}, rpm));
}

TEST(RefinedLine, KeepsWithinItsToleranceOfABoundaryInClosedForm) {
  for (const double tolerance : {0.1, 0.02, 0.002}) {
    const Lobes chart = closed_form_chart({tolerance, 20000});
    ASSERT_TRUE(chart.line);
    EXPECT_TRUE(chart.line->met);
    EXPECT_LE(chart.line->error_estimate, tolerance);
    EXPECT_LE(worst_of_closed_form(chart), tolerance) << "the estimate is on the safe side";
    EXPECT_EQ(std::ssize(chart.rows), 40 + chart.line->speeds_added);
    EXPECT_TRUE(std::ranges::is_sorted(chart.rows, {}, &LobeRow::spindle_speed_rpm));
    const int count = static_cast<int>(chart.rows.size());
    const Lobes even = even_chart(3000.0, 18000.0, count, row_in_closed_form, {});
    EXPECT_GT(worst_of_closed_form(even), 2.0 * tolerance) << "as many speeds, evenly spaced";
  }
}

TEST(RefinedLine, TellsWhatIsOffWhenNoMoreSpeedsMayBeAdded) {
  const Lobes full = closed_form_chart({0.02, 20000});
  const Lobes some = closed_form_chart({0.02, 12});
  EXPECT_EQ(some.line->speeds_added, 12);
  EXPECT_FALSE(some.line->met);
  EXPECT_GT(some.line->error_estimate, 0.02);
  EXPECT_GT(full.line->speeds_added, 12);
  const Lobes none = closed_form_chart({0.02, 0});
  EXPECT_EQ(none.rows.size(), 40U);
  EXPECT_FALSE(none.line->met);
}

/// Two lobes that meet between the speeds at x = 0 and 1.8 of 40 rpm each: the left one's 1/w falls as a parabola, so
/// that it rises in the gap as its last chord does not tell, and the right one's is straight.
TEST(RefinedLine, SeesThePeakOfALobeThatBendsUpwardsBeforeItsCorner) {
  const auto left = [](double x) { return 2000.0 - 38.0 * x - 32.0 * x * (x + 1.0); };
  const auto right = [](double x) { return 1945.0 + 655.0 * (x - 1.8); };
  const auto row = [&](double x) {
    LobeRow result;
    result.spindle_speed_rpm = 10000.0 + 40.0 * x;
    const bool on_left = left(x) > right(x);
    result.limiting_depth_m = 1.0 / (on_left ? left(x) : right(x));
    result.chatter_frequency_hz = (on_left ? 21.5 : 12.3) * result.spindle_speed_rpm / 30.0;
    return result;
  };
  std::vector<LobeRow> rows;
  for (const double x : {-2.0, -1.0, 0.0, 1.8, 1.9, 2.0}) rows.push_back(row(x));
  double off = 0.0;
  for (double x = 0.0; x < 1.8; x += 0.001) {
    const double line = rows[2].limiting_depth_m + x / 1.8 * (rows[3].limiting_depth_m - rows[2].limiting_depth_m);
    off = std::max(off, std::abs(line / row(x).limiting_depth_m - 1.0));
  }
  EXPECT_GT(off, 0.07);
  EXPECT_GE(line_gaps(rows, two_teeth())[2].error, off);
}

/// Two modes beside each other: lobes of one ⌊f_c T⌋ whose boundaries cross at 4000 rpm, and the rows know both.
LobeRow row_of_two_modes(double rpm) {
  const double x = (rpm - 4000.0) / 4000.0;
  LobeRow row;
  row.spindle_speed_rpm = rpm;
  row.crossings = {{1e-3 * (1.0 + 8.0 * x), 2070.0 * (1.0 + 0.8 * x), Bifurcation::hopf, 2, 1e-9},
                   {1e-3 * (1.0 - 8.0 * x), 2080.0 * (1.0 + 0.8 * x), Bifurcation::hopf, 2, 1e-9}};
  std::ranges::sort(row.crossings, {}, &LobePoint::depth_m);
  take_limit_from_crossings(row);
  return row;
}

TEST(RefinedLine, SeesTheCornerOfTwoLobesOfNearlyEqualFrequencies) {
  MillingProcess process = two_teeth();
  process.cutter.teeth = 1;
  std::vector<LobeRow> rows;
  for (const double rpm : {3955.0, 3985.0, 4015.0, 4045.0}) rows.push_back(row_of_two_modes(rpm));
  const LineGap gap = line_gaps(rows, process)[1];
  const double chord = row_of_two_modes(3985.0).limiting_depth_m;  // equal at both ends
  EXPECT_TRUE(gap.corner);
  EXPECT_GE(gap.error, 1.0 - chord / row_of_two_modes(4000.0).limiting_depth_m);
  EXPECT_NEAR(gap.corner_rpm, 4000.0, 1.0);
}

/// Two lobes, even on their own sides of 10000 rpm, that fall in 1/w by four fifths up to the other side's row, which
/// knows them as deeper crossings: what a lobe's own rows say of it is level with the chord.
TEST(RefinedLine, LobesGoThroughTheirDeeperCrossingsOnTheOtherSideOfACorner) {
  const auto row = [](double rpm, double side, bool knows_other) {
    LobeRow result;
    result.spindle_speed_rpm = rpm;
    result.crossings = {{1e-3, 1660.0 + 5.0 * side, Bifurcation::hopf, 2, 1e-9}};
    if (knows_other) result.crossings.push_back({5e-3, 1660.0 - 5.0 * side, Bifurcation::hopf, 2, 1e-9});
    take_limit_from_crossings(result);
    return result;
  };
  MillingProcess process = two_teeth();
  process.cutter.teeth = 1;
  const std::vector<LobeRow> rows{row(9850.0, -1.0, false), row(9950.0, -1.0, true), row(10050.0, 1.0, true),
                                  row(10150.0, 1.0, false)};
  // The parabola in 1/w through 1, 1 and 0.2 at equal steps, amid the last two of them: 0.7, where both lobes meet.
  const LineGap gap = line_gaps(rows, process)[1];
  EXPECT_TRUE(gap.corner);
  EXPECT_GE(gap.error, 1.0 - 0.7);
  EXPECT_NEAR(gap.corner_rpm, 10000.0, 1.0);
}

// Between 5050 and 5100 rpm the multipliers of the Hopf lobe pass -1, and a flip lobe of ten rpm lies there.
TEST(RefinedLine, SeesAFlipLobeThatLiesBetweenTwoSpeedsOnAHopfLobe) {
  const MillingProcess process = testing::benchmark_process(0.5);
  const RelativeStructure structure =
      relative_structure(testing::modal_model({{922.0, 0.011, 0.03993, Eigen::Vector3d::UnitX()},
                                               {922.0, 0.011, 0.03993, Eigen::Vector3d::UnitY()}}),
                         "P");
  const StabilityOptions options;
  const RowAt row_at = [&](double rpm, const StabilityOptions& with) {
    return limiting_depth(structure, process, rpm, with);
  };
  const Lobes even = even_chart(5000.0, 5200.0, 5, row_at, options);
  for (const LobeRow& row : even.rows) ASSERT_EQ(row.kind, Bifurcation::hopf);
  const Lobes chart = refined(even, row_at, process, options, {0.02, 400});
  EXPECT_TRUE(chart.line->met);
  EXPECT_TRUE(std::ranges::any_of(chart.rows, [](const LobeRow& row) { return row.kind == Bifurcation::flip; }));
  EXPECT_LT(std::ranges::max(distances(chart, row_at, options, spindle_speeds(5000.5, 5199.5, 200))), 0.03);
}

TEST(RefinedLine, AddedSpeedsFollowTheCrossingsBesideTheFirstAndAskedOnesAll) {
  std::mutex writing;
  std::map<double, double> followed;
  const auto row_at = [&](double rpm, const StabilityOptions& with) {
    const std::lock_guard lock(writing);
    followed[rpm] = with.follow;
    return row_in_closed_form(rpm, with);
  };
  const StabilityOptions options;
  constexpr double asked_rpm = 9876.0;
  const Lobes even = even_chart(3000.0, 18000.0, 40, row_in_closed_form, options);
  const Lobes chart = refined(even, row_at, two_teeth(), options, {}, {asked_rpm});
  ASSERT_GT(chart.line->speeds_added, 10);
  ASSERT_TRUE(followed.contains(asked_rpm));
  for (const auto& [rpm, follow] : followed) {
    if (rpm == asked_rpm) EXPECT_EQ(follow, options.follow);
    else EXPECT_EQ(follow, 3.0) << rpm;
  }
}

TEST(RefinedLine, SeesAFoldLobeThatLiesBetweenTwoSpeedsOnAHopfLobe) {
  // The chatter frequency passes seven times that of the turns at 5300 rpm; within 15 rpm of it a fold cuts 10 % off.
  const auto row_at = [](double rpm, const StabilityOptions&) {
    LobeRow row;
    row.spindle_speed_rpm = rpm;
    row.limiting_depth_m = 1e-3 - 1e-7 * (rpm - 5300.0);
    row.chatter_frequency_hz = 7.0 * 5300.0 / 60.0 + 0.02 * (rpm - 5300.0);
    if (std::abs(rpm - 5300.0) < 15.0) {
      row.limiting_depth_m *= 0.9;
      row.chatter_frequency_hz = 7.0 * rpm / 60.0;
      row.kind = Bifurcation::fold;
    }
    return row;
  };
  MillingProcess process = two_teeth();
  process.cutter.teeth = 1;
  const StabilityOptions options;
  const Lobes chart = refined(even_chart(5020.0, 5720.0, 8, row_at, options), row_at, process, options, {});
  EXPECT_NEAR(line_at(chart, 5290.0), row_at(5290.0, options).limiting_depth_m, 2e-2 * 1e-3);
  EXPECT_NEAR(line_at(chart, 5310.0), row_at(5310.0, options).limiting_depth_m, 2e-2 * 1e-3);
  EXPECT_TRUE(chart.line->met);
}

/// A row of a motion that turns by so many periods in a turn of a cutter with one tooth.
LobeRow row_with_periods(double rpm, double periods, bool at_limit) {
  LobeRow row;
  row.spindle_speed_rpm = rpm;
  row.limiting_depth_m = at_limit ? 10e-3 : 9e-3 + 5e-6 * (rpm - 5400.0);
  row.at_limit = at_limit;
  row.modulus_at_limit = at_limit ? 0.99 : 0.0;
  row.chatter_frequency_hz = periods * rpm / 60.0;
  return row;
}

TEST(RefinedLine, LooksWhereAMotionPassesTheRealAxis) {
  MillingProcess process = two_teeth();
  process.cutter.teeth = 1;
  const auto gap = [&](const std::vector<double>& periods, bool ends_at_limit) {
    std::vector<LobeRow> rows;
    for (std::size_t i = 0; i < periods.size(); ++i)
      rows.push_back(row_with_periods(5400.0 + 20.0 * static_cast<double>(i), periods[i], ends_at_limit && i == 3));
    return line_gaps(rows, process)[2];
  };
  const LineGap fold = gap({7.09, 7.06, 7.03, 6.99}, false);  // 7 three quarters along the gap of 20 rpm
  EXPECT_TRUE(std::isinf(fold.error));
  EXPECT_NEAR(fold.corner_rpm, 5455.0, 0.01);
  const LineGap no_flip = gap({5.54, 5.53, 5.52, 4.97}, true);  // 5.51 at its end
  EXPECT_TRUE(std::isfinite(no_flip.error));
  const LineGap below_limit = gap({5.60, 5.56, 5.52, 4.97}, true);  // 5.5 halfway to 5.48
  EXPECT_TRUE(std::isinf(below_limit.error));
  EXPECT_NEAR(below_limit.corner_rpm, 5450.0, 0.01);
}

// Beside the corner at 10150 rpm the lobe has a dip of 4 % within the gap of two even speeds, of which no row tells.
TEST(RefinedLine, LooksIntoAWideGapThatOneSideAloneTellsOf) {
  const auto row_at = [](double rpm, const StabilityOptions&) {
    const double from_dip = (rpm - 10000.0) / 40.0, from_corner = rpm - 10150.0;
    LobeRow row;
    row.spindle_speed_rpm = rpm;
    row.limiting_depth_m = 1e-3 * (1.0 - 0.04 * std::exp(-from_dip * from_dip)) + 5e-6 * std::max(0.0, from_corner);
    row.chatter_frequency_hz = (from_corner < 0.0 ? 21.5 : 12.3) * rpm / 30.0;
    return row;
  };
  const StabilityOptions options;
  const Lobes even = even_chart(9300.0, 10700.0, 8, row_at, options);
  EXPECT_GT(distances(even, row_at, options, {10000.0}).front(), 0.04);
  const Lobes chart = refined(even, row_at, two_teeth(), options, {0.02, 400});
  EXPECT_TRUE(chart.line->met);
  EXPECT_LE(std::ranges::max(distances(chart, row_at, options, spindle_speeds(9301.0, 10699.0, 1000))), 0.02);
}

TEST(RefinedLine, DoesNotTakeABentLobeForStraightWhereAnotherRunsAboveIt) {
  // 1/w is a parabola, and a deeper crossing lies where the frequencies of two rows point: the lobe seems to part.
  std::vector<LobeRow> rows;
  const auto row_at = [](double rpm) {
    const double x = (rpm - 4000.0) / 20.0, f = 508.0 + x - 0.4 * x * x;
    LobeRow row;
    row.spindle_speed_rpm = rpm;
    row.crossings = {{1e-3 / (1.0 - 0.07 * x * x), f, Bifurcation::hopf, 2, 1e-9},
                     {19e-3, f + 4.8, Bifurcation::hopf, 2, 1e-9}};
    take_limit_from_crossings(row);
    return row;
  };
  for (const double rpm : {3930.0, 3950.0, 3970.0, 4030.0, 4050.0, 4070.0}) rows.push_back(row_at(rpm));
  MillingProcess process = two_teeth();
  process.cutter.teeth = 1;
  const double chord = rows[2].limiting_depth_m;
  EXPECT_GE(line_gaps(rows, process)[2].error, chord / row_at(4000.0).limiting_depth_m - 1.0);
}

TEST(RefinedLine, GoesThroughTheSpeedsThatAreAsked) {
  const Lobes without = closed_form_chart({});
  const double within = without.rows[7].spindle_speed_rpm + 1.0;
  const Lobes with = closed_form_chart({}, {within, 6000.25, 6000.25, 2000.0, 18000.0, 19000.0});
  const auto has = [&](double rpm) { return std::ranges::count(with.rows, rpm, &LobeRow::spindle_speed_rpm); };
  EXPECT_EQ(has(within), 1);
  EXPECT_EQ(has(6000.25), 1);
  EXPECT_EQ(has(18000.0), 1);
  EXPECT_EQ(has(2000.0) + has(19000.0), 0) << "beyond the chart";
  EXPECT_EQ(line_at(with, 6000.25), row_in_closed_form(6000.25, {}).limiting_depth_m);
  for (const LobeRow& row : without.rows) EXPECT_EQ(has(row.spindle_speed_rpm), 1) << "the rows stay";
}

TEST(RefinedLine, TakesKeptRowsOfTheSameSpeedOnly) {
  std::map<std::size_t, std::vector<LobeRow>> pieces;
  std::atomic<int> found = 0;
  const KeptRows kept{[&](std::size_t first) {
                        const auto piece = pieces.find(first);
                        if (piece == pieces.end()) return std::vector<LobeRow>{};
                        ++found;
                        return piece->second;
                      },
                      [&](std::size_t first, const std::vector<LobeRow>& rows) { pieces[first] = rows; }};
  const Lobes once = closed_form_chart({}, {}, kept);
  EXPECT_EQ(std::ssize(pieces), once.line->speeds_added);
  pieces.begin()->second.front().spindle_speed_rpm += 1.0;
  for (auto& [first, rows] : pieces) rows.front().nodes = 7;
  const Lobes again = closed_form_chart({}, {}, kept);
  EXPECT_EQ(found, once.line->speeds_added);
  ASSERT_EQ(again.rows.size(), once.rows.size());
  EXPECT_EQ(std::ranges::count(again.rows, 7, &LobeRow::nodes), once.line->speeds_added - 1);
  for (std::size_t i = 0; i < once.rows.size(); ++i)
    EXPECT_EQ(again.rows[i].spindle_speed_rpm, once.rows[i].spindle_speed_rpm);
}

TEST(RefinedLine, NeedsNoSpeedsWhereNothingBends) {
  const RowAt flat = [](double rpm, const StabilityOptions& options) {
    LobeRow row;
    row.spindle_speed_rpm = rpm;
    row.limiting_depth_m = options.depth_limit_m;
    row.at_limit = true;
    row.chatter_frequency_hz = 500.0;
    row.modulus_at_limit = 0.5;
    row.status = StabilityStatus::stable_to_depth_limit;
    return row;
  };
  const StabilityOptions options;
  const Lobes chart = refined(even_chart(9000.0, 9100.0, 10, flat, options), flat, two_teeth(), options, {});
  EXPECT_EQ(chart.rows.size(), 10U);
  EXPECT_EQ(chart.line->error_estimate, 0.0);
  EXPECT_TRUE(chart.line->met);
}

TEST(RefinedLine, DoesNotChaseErrorsOfTheRowsThemselves) {
  const RowAt rough = [](double rpm, const StabilityOptions& options) {
    LobeRow row = row_in_closed_form(rpm, options);
    row.limiting_depth_m *= 1.0 + 0.05 * std::sin(1e4 * rpm);
    row.error_estimate = 0.05;
    return row;
  };
  const StabilityOptions options;
  const Lobes chart =
      refined(even_chart(15000.0, 18000.0, 40, rough, options), rough, two_teeth(), options, {0.002, 20000});
  EXPECT_LT(chart.line->speeds_added, 2000) << "without regard to their errors all 20000 are taken";
}

TEST(RefinedLine, RefusesWhatIsNoChartOrNoTolerance) {
  const StabilityOptions options;
  const Lobes chart = even_chart(9000.0, 9100.0, 2, row_in_closed_form, options);
  Lobes one = chart;
  one.rows.pop_back();
  EXPECT_THROW((void)refined(one, row_in_closed_form, two_teeth(), options, {}), core::InputError);
  for (const LineOptions bad : {LineOptions{0.0, 10}, LineOptions{1.0, 10}, LineOptions{NAN, 10}, LineOptions{0.02, -1},
                                LineOptions{0.02, 10, 0.0}, LineOptions{0.02, 10, NAN}})
    EXPECT_THROW((void)refined(chart, row_in_closed_form, two_teeth(), options, bad), core::InputError);
}

TEST(RefinedLine, DoesNotDependOnTheNumberOfThreads) {
  const MillingProcess process = testing::benchmark_process(0.1);
  const StabilityOptions options;
  const RowAt row_at = [&](double rpm, const StabilityOptions& with) {
    return limiting_depth(testing::benchmark_structure(), process, rpm, with);
  };
  const int threads = core::thread_count();
  std::vector<Lobes> charts;
  for (const int count : {1, 3}) {
    core::set_thread_count(count);
    charts.push_back(
        refined(stability_lobes(testing::benchmark_structure(), process, spindle_speeds(7000.0, 12000.0, 12), options),
                row_at, process, options, {}));
  }
  core::set_thread_count(threads);
  ASSERT_EQ(charts[0].rows.size(), charts[1].rows.size());
  EXPECT_GT(charts[0].line->speeds_added, 5);
  for (std::size_t i = 0; i < charts[0].rows.size(); ++i)
    EXPECT_EQ(charts[0].rows[i].limiting_depth_m, charts[1].rows[i].limiting_depth_m);
}

}  // namespace
}  // namespace thinwall::milling::refined_lobes_test

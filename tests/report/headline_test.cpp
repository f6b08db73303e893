#include "report/page/headline.hpp"

#include <gtest/gtest.h>

#include "report/lobes/lobes_answers.hpp"
#include "report/lobes/lobes_report.hpp"
#include "report/terminal_report.hpp"

namespace thinwall::report::headline_test {
namespace {

using study::ChartOf;

LobesSummary chart(ChartOf name, double depth_m, bool at_limit) {
  LobesSummary chart;
  chart.name = name;
  chart.minimum_depth_m = 0.001;
  chart.speeds = 10;
  chart.error_estimate_relative = 1e-4;
  chart.best_pocket = {2250.0, 0.02, true, "tool_length", {}, 2190.0, 2260.0, false};
  CaseSpeedSummary& row = chart.at_case_speed.emplace();
  row.at_depth_limit = at_limit;
  row.limiting_depth_m = depth_m;
  row.spindle_speed_rpm = 1900.0;
  row.error_estimate_relative = 1e-4;
  row.status = at_limit ? "stable_to_depth_limit" : "converged";
  return chart;
}

OperatingPointSummary point(ChartOf name, bool stable, double margin_m) {
  OperatingPointSummary point;
  point.chart = name;
  point.spindle_speed_rpm = 1900.0;
  point.depth_m = 0.002;
  point.stable = stable;
  point.depth_margin_m = margin_m;
  point.depth_margin_at_limit = stable;
  point.status = stable ? "stable_to_depth_limit" : "converged";
  return point;
}

Summary both(const std::string& cut_at, const std::string& held_at) {
  Summary summary;
  summary.lobes = {chart(ChartOf::part, 0.0017, false), chart(ChartOf::supported, 0.02, true)};
  summary.cutting.emplace();
  summary.cutting->depth_limit_is = "tool_length";
  summary.cutting->at = cut_at;
  summary.contacts.emplace_back();
  summary.contacts[0].part = held_at;
  summary.contacts[0].robot = "R";
  return summary;
}

TEST(Headline, SaysTheAnswerFirstAndTheSupportedPartBeforeTheBareOne) {
  Summary summary = both("P", "P");
  summary.operating_points = {point(ChartOf::part, false, -0.0003), point(ChartOf::supported, true, 0.018)};
  const auto text = headline(summary);
  ASSERT_EQ(text.size(), 2U);
  EXPECT_EQ(text[0], "With the robot at P: stable up to 20 mm at 1900 rpm (tool length); without: 1.7 mm.");
  EXPECT_EQ(
      text[1],
      "Best pocket 20 mm at 2250 rpm (tool length), nine tenths of it at 2190 to 2260 rpm; margin at 1900 rpm and "
      "2 mm: at least 18 mm; estimated error 0.01 %.");
}

TEST(Headline, DoubtsALimitThatHangsOnLinesBelowTheFirstResonance) {
  Summary summary = both("P", "P");
  summary.lobes[1].below_first_resonance = {2.0, 620.0};
  const auto text = headline(summary);
  ASSERT_EQ(text.size(), 3U);
  EXPECT_EQ(text[1],
            "To be doubted: the limit hangs on measured lines below the first resonance (chatter at 2 Hz, first "
            "resonance at 620 Hz).");
}

TEST(Headline, SaysAboveWhichDepthTheContactIsLost) {
  Summary summary = both("P", "P");
  summary.lobes[1].at_case_speed->contact = {60.0, {}};
  EXPECT_EQ(headline(summary)[0].find("contact"), std::string::npos) << "it holds";
  summary.lobes[1].at_case_speed->contact = {60.0, 0.00031};
  EXPECT_EQ(headline(summary)[0],
            "With the robot at P: stable up to 20 mm at 1900 rpm (tool length) if the contact holds; it is lost above "
            "0.31 mm; without: 1.7 mm.");
}

TEST(Headline, NamesAnEdgeOfTheChartAndARobustPocketAsSuch) {
  Summary summary = both("P", "P");
  summary.lobes[1].robust.emplace();
  EXPECT_EQ(headline(summary)[1].find("Best robust pocket 20 mm at 2250 rpm"), 0U);
  summary.lobes[1].best_pocket->at_chart_edge = true;
  EXPECT_EQ(headline(summary)[1].find("Edge of the chart 20 mm at 2250 rpm"), 0U);
  EXPECT_EQ(headline(summary)[1].find("est pocket"), std::string::npos);
}

/// A list of pockets beside it may hold deeper ones, beyond the machine's limits for instance.
TEST(Headline, CallsThatPocketBestWhichTheTerminalAndTheChartsReportCallBest) {
  Summary summary = both("P", "P");
  summary.lobes = {chart(ChartOf::supported, 0.0017, false)};
  summary.lobes[0].best_pockets = {{8888.0, 0.025, false, "stability", {}, 8700.0, 8900.0, false}};
  summary.lobes[0].best_pocket = {2250.0, 0.012, false, "stability", {}, 2190.0, 2260.0, false};
  for (const bool at_edge : {false, true}) {
    summary.lobes[0].best_pocket->at_chart_edge = at_edge;
    EXPECT_NE(
        headline(summary)[1].find(at_edge ? "Edge of the chart 12 mm at 2250 rpm" : "Best pocket 12 mm at 2250 rpm"),
        std::string::npos);
    EXPECT_NE(lobes_report(summary, "results")
                  .find(at_edge ? "edge of the chart: 12.000 mm at 2250 rpm" : "best pocket: 12.000 mm at 2250 rpm"),
              std::string::npos);
    const std::string terminal = terminal_report(summary, "results");
    EXPECT_NE(terminal.find("12.00 mm at 2250 rpm"), std::string::npos);
    EXPECT_EQ(terminal.find("(edge)") != std::string::npos, at_edge);
    EXPECT_EQ(terminal.find("8888"), std::string::npos);
  }
}

TEST(Headline, TellsTheCutFromTheContactAndADepthLimitThatIsNotTheTool) {
  Summary summary = both("P", "B");
  summary.cutting->depth_limit_is = "depth_limit";
  EXPECT_EQ(headline(summary)[0],
            "With the robot at B, cut at P: stable up to 20 mm at 1900 rpm (depth limit); without: 1.7 mm.");
  EXPECT_EQ(headline(summary)[1].find("margin"), std::string::npos) << "no operating point, no margin";
  summary.lobes = {chart(ChartOf::part, 0.0017, false)};
  EXPECT_EQ(headline(summary)[0], "Part alone, cut at P: stable up to 1.7 mm at 1900 rpm.");
  summary.lobes = {chart(ChartOf::tool, 0.0017, false)};
  EXPECT_EQ(headline(summary)[0], "This tool: stable up to 1.7 mm at 1900 rpm.");
}

TEST(Headline, AnAnswerThatDidNotConvergeIsNotCalledStable) {
  Summary summary = both("P", "P");
  summary.lobes[1].at_case_speed->at_depth_limit = false;
  summary.lobes[1].at_case_speed->status = "node_limit_reached";
  summary.lobes[0].at_case_speed->status = "crossing_missed";
  EXPECT_EQ(headline(summary)[0],
            "With the robot at P: not converged: 20 mm at 1900 rpm; without: not converged, 1.7 mm.");
  for (LobesSummary& of : summary.lobes) of.at_case_speed.reset();
  EXPECT_EQ(headline(summary)[0], "With the robot at P: stable up to 1 mm at every speed; without: 1 mm.");
  summary.lobes[1].speeds_not_converged = 3;
  EXPECT_EQ(headline(summary)[0],
            "With the robot at P: not converged: 1 mm at every speed (3 of 10 speeds did not reach the tolerance); "
            "without: 1 mm.");
  OperatingPointSummary open = point(ChartOf::supported, true, 0.018);
  open.status = "crossing_missed";
  summary.operating_points = {open};
  EXPECT_NE(headline(summary)[1].find("margin at 1900 rpm and 2 mm: not converged"), std::string::npos);
  EXPECT_EQ(sentences(summary)[0],
            "With the robot, 1900 rpm and 2 mm: not converged: stable, margin in depth at least 18 mm.");
}

/// 18 mm whose reduction moves it by 0.30 mm is right to 1.7 %, whatever the collocation reaches.
TEST(Headline, TheErrorIsThatOfTheDepthsInTheSentence) {
  Summary summary;
  summary.lobes = {chart(ChartOf::part, 0.018, false), chart(ChartOf::supported, 0.0137, false)};
  summary.lobes[0].error_budget.emplace().largest_truncation_relative = 0.5;
  summary.lobes[0].at_case_speed->error_budget.emplace().truncation_m = -0.0003;
  EXPECT_NE(headline(summary)[1].find("estimated error 1.7 %"), std::string::npos) << headline(summary)[1];
  summary.lobes[1].error_budget.emplace().largest_noise_relative = 0.2;
  summary.lobes[1].at_case_speed->error_budget.emplace().noise_deviation_m = 0.000685;
  EXPECT_NE(headline(summary)[1].find("estimated error 10 %"), std::string::npos) << "twice the deviation of 5 %";
  summary.lobes[1].at_case_speed->error_budget->noise_deviation_m.reset();
  EXPECT_NE(headline(summary)[1].find("estimated error 40 %"), std::string::npos) << "not known there: the chart's";
}

/// The range by what was identified stands behind the limit that it is of, and counts as its error.
TEST(Headline, TellsTheRangeByWhatWasIdentified) {
  Summary summary;
  summary.lobes = {chart(ChartOf::supported, 0.010, false)};
  summary.lobes[0].at_case_speed->error_budget.emplace().identification = {0.0092, 0.0115};
  EXPECT_NE(headline(summary)[0].find("stable up to 10 mm at 1900 rpm, 95 %: 9.2 to 11.5 mm"), std::string::npos)
      << headline(summary)[0];
  EXPECT_NE(headline(summary)[1].find("estimated error 15 %"), std::string::npos) << headline(summary)[1];
}

PathSummary path(ChartOf name, double depth_m) {
  PathSummary path;
  path.name = name;
  path.speeds = 40;
  path.weakest.position = 10;
  path.weakest.minimum_depth_m = depth_m;
  path.positions.resize(11, path.weakest);
  path.deepest_everywhere = {10615.0, 0.00203, false, 9};
  path.error_estimate_relative = 1e-3;
  return path;
}

TEST(Headline, OfAPathIsOfAllItsPositions) {
  Summary summary = both("P", "B");
  summary.path = {path(ChartOf::part, 1.4e-5), path(ChartOf::supported, 0.000512)};
  auto text = headline(summary);
  EXPECT_EQ(text[0],
            "Along the path with the robot: stable up to 0.512 mm at every speed (weakest at position 10 of 11); "
            "without: 0.014 mm (weakest at position 10 of 11).");
  EXPECT_EQ(text[1], "Best for the whole path 2.03 mm at 10615 rpm (limited at position 9); estimated error 0.1 %.");
  EXPECT_EQ(sentences(summary)[0],
            "With the robot at B, cut at P: stable up to 20 mm at 1900 rpm (tool length); without: 1.7 mm.")
      << "the single position comes second";
  summary.path[1].at_case_speed = {1900.0, 0.009, false, 6, 1e-3, "converged", 0};
  EXPECT_EQ(
      headline(summary)[0].find("Along the path with the robot: stable up to 9 mm at 1900 rpm (weakest at position "
                                "6 of 11); without:"),
      0U);
  summary.path[1].at_case_speed->positions_not_converged = 1;
  EXPECT_EQ(headline(summary)[0].find("Along the path with the robot: not converged: 9 mm at 1900 rpm"), 0U);
}

TEST(Headline, OfAPartAloneNamesItsModes) {
  Summary summary;
  summary.part.emplace();
  summary.part->modes.resize(2);
  summary.part->modes[0].rigid_body = true;
  summary.part->modes[1].frequency_hz = 212.918;
  const auto text = headline(summary);
  ASSERT_EQ(text.size(), 1U);
  EXPECT_EQ(text[0], "First natural frequencies of the part: 212.9 Hz.");
}

TEST(Sentences, AreThePointsAndWhatTheRunSaidButForWhatTablesHave) {
  Summary summary = both("P", "P");
  OperatingPointSummary lost = point(ChartOf::supported, true, 0.018);
  lost.contact.emplace().lost = true;
  summary.operating_points = {point(ChartOf::part, false, -0.0003), lost};
  summary.lobes[0].name = ChartOf::part;
  summary.lobes[0].at_case_speed.emplace().sensitivities = {{"K_t", {}, -1.0}};
  summary.sentences = {"Part alone: 1 % more K_t lowers the limit by 1.00 %.", "Part alone: a remark."};
  summary.coupling.emplace();
  summary.coupling->route_difference.emplace().max_relative = 7.4e-13;
  EXPECT_EQ(
      sentences(summary),
      (std::vector<std::string>{"Part alone, 1900 rpm and 2 mm: chatter, 0.3 mm too deep.",
                                "With the robot, 1900 rpm and 2 mm: stable, margin in depth at least 18 mm; the cut "
                                "pulls the contact open.",
                                "Part alone: a remark."}));
}

TEST(Sentences, TellTheBoundOfTheModesThatActStatically) {
  LobesSummary some = chart(ChartOf::part, 0.001, false);
  some.static_share = 0.014;
  some.modes_up_to_hz = 18e3;
  EXPECT_EQ(chart_notes(some), (std::vector<std::string>{"1.4 % of the static compliance lies in modes above 18 kHz, "
                                                         "taken without their dynamics"}));
  some.static_share = 0.001;
  EXPECT_TRUE(chart_notes(some).empty()) << "not worth a word";
}

}  // namespace
}  // namespace thinwall::report::headline_test

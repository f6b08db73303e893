// Two runs for a reader: their answers, and the figures on which these hang.
#include "report/compared_answers.hpp"

#include <gtest/gtest.h>

#include "report/summary/summary_schema.hpp"
#include "tests/report/result_folder.hpp"

namespace thinwall::report::compared_answers_test {

namespace {

namespace fs = std::filesystem;

/// A run with a chart of that least depth at the case's speed, and a part of so many modes.
fs::path run_of(const std::string& name, double depth_m, double first_mode_hz, int modes = 2) {
  fs::path folder = result_folder(name);
  Summary summary;
  summary.case_name = "small";
  LobesSummary& chart = summary.lobes.emplace_back();
  chart.name = study::ChartOf::supported;
  chart.minimum_depth_m = depth_m;
  chart.at_spindle_speed_rpm = 2000.0;
  chart.best_pockets.push_back({1e7 * depth_m, 5.0 * depth_m, false, "stability", {}});
  CaseSpeedSummary& row = chart.at_case_speed.emplace();
  row.spindle_speed_rpm = 1900.0;
  row.limiting_depth_m = 2.0 * depth_m;
  row.status = "converged";
  PartSummary& part = summary.part.emplace();
  for (int i = 0; i < modes; ++i) part.modes.push_back({first_mode_hz * (i + 1), {}, 0.0, 0.0, {}});
  core::write_file_atomically(folder / "summary.json", summary_json(summary).dump());
  return folder;
}

TEST(ComparedAnswers, BothAnswersStandFirst) {
  const fs::path a = run_of("answers_a", 1e-3, 200.0), b = run_of("answers_b", 1.1e-3, 200.0);
  const std::string text = answers_text(a, b);
  const auto first = text.find("stable up to 2 mm at 1900 rpm"), second = text.find("stable up to 2.2 mm at 1900 rpm");
  ASSERT_NE(first, std::string::npos) << text;
  ASSERT_NE(second, std::string::npos) << text;
  EXPECT_LT(text.find(a.string()), first);
  EXPECT_LT(first, text.find(b.string()));
}

TEST(ComparedAnswers, ASummaryThatIsNotReadIsToldAndComparedAllTheSame) {
  const fs::path a = run_of("unread_a", 1e-3, 200.0), b = result_folder("unread_b");
  core::write_file_atomically(b / "summary.json", R"({"part": 3})");
  EXPECT_NE(answers_text(a, b).find("is not one of this version"), std::string::npos);
}

TEST(ComparedAnswers, TheTableHoldsTheWeightiestFiguresWithBothValuesAndTheChange) {
  const fs::path a = run_of("figures_a", 1e-3, 200.0, 20), b = run_of("figures_b", 1.1e-3, 210.0, 20);
  const std::string text = main_figures_text(compare_results(a, b, 1e-9));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + 10) << text;
  const auto at_speed = text.find("lobes[0].at_case_speed.limiting_depth_m"),
             least = text.find("lobes[0].minimum_depth_m"), mode = text.find("part.modes[0].frequency_hz");
  ASSERT_NE(mode, std::string::npos) << text;
  EXPECT_LT(at_speed, least);
  EXPECT_LT(least, mode);
  const std::string row = text.substr(least, text.find('\n', least) - least);
  for (const char* part : {" 1 mm ", " 1.1 mm ", " +10 % ", "least limiting depth of all speeds (supported)"})
    EXPECT_NE(row.find(part), std::string::npos) << row;
}

TEST(ComparedAnswers, SpeedsAreWholeNumbers) {
  const fs::path a = run_of("speeds_a", 1e-3, 200.0), b = run_of("speeds_b", 1.2e-3, 200.0);
  const std::string text = main_figures_text(compare_results(a, b, 1e-9));
  EXPECT_NE(text.find(" 10000 rpm     12000 rpm "), std::string::npos) << text;
}

TEST(ComparedAnswers, FiguresWithinTheToleranceAreNotShown) {
  const fs::path a = run_of("close_a", 1e-3, 200.0), b = run_of("close_b", 1.0001e-3, 200.0);
  EXPECT_EQ(main_figures_text(compare_results(a, b, 1e-2)), "");
  const std::string text = main_figures_text(compare_results(a, b, 1e-6));
  EXPECT_NE(text.find("0.001 m"), std::string::npos) << text << "what four digits do not tell apart";
  EXPECT_NE(text.find("0.0010001 m"), std::string::npos) << text;
}

TEST(ComparedAnswers, APathOfTheSummaryHasItsMeaning) {
  EXPECT_EQ(meaning_at("lobes[3].minimum_depth_m"), "least limiting depth of all speeds");
  EXPECT_EQ(meaning_at("part.modes[12].frequency_hz"), "natural frequency");
  EXPECT_EQ(meaning_at("mesh"), "mesh of the part");
  EXPECT_EQ(meaning_at("part.modes[0].nothing"), "");
  EXPECT_EQ(meaning_at("nothing.at.all"), "");
}

}  // namespace

}  // namespace thinwall::report::compared_answers_test

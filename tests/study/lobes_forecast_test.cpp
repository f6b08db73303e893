// The forecast of a chart's time: its count of rows against those that a run computes, and what it does where rows do
// not end in time.

#include "study/lobes/lobes_forecast.hpp"

#include <gtest/gtest.h>

#include <complex>
#include <filesystem>
#include <string>
#include <vector>

#include "case/reader.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/messages.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "study/run.hpp"
#include "tests/case/case_text.hpp"
#include "tests/core/temporary_folder.hpp"

namespace thinwall::tests::lobes_forecast_test {

using namespace cases;
using namespace study;

namespace {

constexpr double enough_s = 20.0;

std::optional<LobesForecast> forecast_of(const std::string& text, double limit_s) {
  return forecast_lobes(parse_case(text, "."), limit_s);
}

/// Seven teeth with helices and unequal pitches, whose rows take seconds to minutes.
std::string slow_case(int speeds) {
  std::string text =
      with(cutter_case(), "teeth = 2\n",
           "teeth = 7\nhelices = [\"38 deg\", \"38 deg\", \"38 deg\", \"38 deg\", \"38 deg\", \"38 deg\", "
           "\"38 deg\"]\npitches = [\"46 deg\", \"52 deg\", \"50 deg\", \"55 deg\", \"49 deg\", \"54 deg\", "
           "\"54 deg\"]\n");
  return with(text, "count = 3", "count = " + std::to_string(speeds));
}

/// The rows of all charts that a run of the case computes.
double rows_of_run(const std::string& text) {
  Kept kept;
  const Results results = run(parse_case(text, "."), {}, kept, {});
  double rows = 0.0;
  for (const StructureLobes& chart : results.lobes) {
    rows += static_cast<double>(chart.lobes.rows.size());
    for (const ComparedLobes& other : chart.compared) rows += static_cast<double>(other.lobes.rows.size());
  }
  return rows;
}

TEST(LobesForecast, CountsTheRowsThatARunComputes) {
  const std::string range = "from = \"5000 rpm\"\nto = \"6000 rpm\"\ncount = 3\n";
  for (const std::string lobes :
       {"from = \"2000 rpm\"\nto = \"12000 rpm\"\ncount = 60\n",
        "from = \"2000 rpm\"\nto = \"12000 rpm\"\ncount = 300\n",
        "from = \"9000 rpm\"\nto = \"10000 rpm\"\ncount = 450\n",
        "from = \"2000 rpm\"\nto = \"12000 rpm\"\ncount = 60\nmost_added = 0\n",
        "from = \"2000 rpm\"\nto = \"12000 rpm\"\ncount = 60\ncompare = [\"zeroth_order\"]\n"}) {
    const std::string text = with(cutter_case(), range, lobes);
    const double said = expected_rows(parse_case(text, ".")).of_structure, taken = rows_of_run(text);
    std::printf("%.0f rows said, %.0f computed\n", said, taken);
    EXPECT_LT(said, 2.0 * taken) << lobes;
    EXPECT_GT(said, 0.5 * taken) << lobes;
  }
}

TEST(LobesForecast, IsTheTimeOfARowTimesTheirNumber) {
  const auto forecast = forecast_of(cutter_case(), enough_s);
  ASSERT_TRUE(forecast);
  EXPECT_FALSE(forecast->at_least);
  EXPECT_GT(forecast->seconds, 0.0);
  EXPECT_EQ(forecast->rows.of_structure, 9.0) << "three speeds, and six may be added";
}

TEST(LobesForecast, RowsThatDoNotEndInTimeBoundItFromBelow) {
  constexpr double limit_s = 0.02;
  const auto forecast = forecast_of(slow_case(1000), limit_s);
  ASSERT_TRUE(forecast);
  EXPECT_TRUE(forecast->at_least);
  EXPECT_GE(forecast->seconds, 0.9 * forecast->rows.of_structure * limit_s / core::thread_count())
      << "the first row takes the limit, and all others do";
}

TEST(LobesForecast, ThereIsNoneWithoutAChart) {
  cases::Case source = parse_case(cutter_case(), ".");
  source.lobes.reset();
  EXPECT_FALSE(forecast_lobes(source, enough_s));
}

TEST(LobesForecast, ModesStandInForThoseOfThePart) {
  const std::string folder = std::string(THINWALL_SOURCE_DIR) + "/cases/cantilever-wall";
  const auto forecast = forecast_lobes(read_case(folder), enough_s);
  ASSERT_TRUE(forecast);
  EXPECT_FALSE(forecast->at_least);
  EXPECT_GT(forecast->seconds, 0.0);
}

/// A case whose tool is known by lines about a mode at so many Hz, in `folder`.
std::string case_with_lines(const std::filesystem::path& folder, double from_hz, double to_hz, double mode_hz,
                            double loss = 0.02) {
  std::string lines = "frequency,real,imag\n";
  for (double hz = from_hz; hz <= to_hz; hz += 2.0) {
    const double r = hz / mode_hz;
    const std::complex<double> H = 1.0 / (4e6 * std::complex<double>(1.0 - r * r, loss * r));
    lines += std::to_string(hz) + "," + core::exact_text(H.real(), core::kind::number) + "," +
             core::exact_text(H.imag(), core::kind::number) + "\n";
  }
  core::write_file_atomically(folder / "tip.csv", lines);
  std::string text = cutter_case();
  const auto from = text.find("[[tool.modes]]"), to = text.find("[cutting]");
  return text.replace(from, to - from,
                      "[[tool.measured]]\nresponse = \"x\"\nforce = \"x\"\nfile = \"tip.csv\"\nquantity = "
                      "\"receptance\"\nunit = \"m/N\"\n");
}

std::string refusal_of_run(const Case& source, const std::vector<milling::OperatingPoint>& points) {
  Kept kept;
  try {
    (void)run(source, {}, kept, {points});
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(LobesForecast, LinesThatDoNotReachTheTeethAreRefusedAsTheRunDoes) {
  // Lines to 1000 Hz about a mode at 600 Hz: two teeth pass at 200 Hz at 6000 rpm, which they hold, but at 500 Hz at
  // 15000 rpm they do not.
  const TemporaryFolder folder;
  const std::string text = case_with_lines(folder.path, 10.0, 1000.0, 600.0);
  const Case slow = parse_case(text, folder.path);
  const auto held = forecast_lobes(slow, enough_s);
  ASSERT_TRUE(held);
  EXPECT_EQ(held->refusal, "");
  const Case fast = parse_case(with(text, "to = \"6000 rpm\"", "to = \"15000 rpm\""), folder.path);
  const auto refused = forecast_lobes(fast, enough_s);
  ASSERT_TRUE(refused);
  EXPECT_NE(refused->refusal.find("do not hold the harmonic at 1100 Hz"), std::string::npos) << refused->refusal;
  EXPECT_NE(refusal_of_run(fast, {}).find("do not hold the harmonic"), std::string::npos);
  const std::vector<milling::OperatingPoint> points{{15000.0, 1e-4}};
  const auto asked = forecast_lobes(slow, enough_s, points);
  ASSERT_TRUE(asked);
  EXPECT_EQ(asked->refusal, "tool.measured: " + refusal_of_run(slow, points)) << "the run is refused by the forecast";
  EXPECT_EQ(asked->refusal, refused->refusal) << "the chart's last speed is asked about there";
}

TEST(LobesForecast, LinesAreAskedBetweenTheEndsOfTheChartToo) {
  // Two teeth pass at 250 Hz and at 1600 Hz at the ends, each 650 Hz or more beside the mode at 900 Hz; at the middle
  // speed it is 925 Hz, and the harmonic at 25 Hz is none of the lines.
  const TemporaryFolder folder;
  const std::string text = case_with_lines(folder.path, 600.0, 3998.0, 900.0);
  const std::string wide =
      with(with(text, "from = \"5000 rpm\"", "from = \"7500 rpm\""), "to = \"6000 rpm\"", "to = \"48000 rpm\"");
  const auto forecast = forecast_lobes(parse_case(wide, folder.path), enough_s);
  ASSERT_TRUE(forecast);
  EXPECT_NE(forecast->refusal.find("beside the resonance at 9"), std::string::npos) << forecast->refusal;
  EXPECT_NE(refusal_of_run(parse_case(wide, folder.path), {}).find("beside the resonance at 9"), std::string::npos);
}

TEST(LobesForecast, WarnsOfNothingForTheRunDoes) {
  // Lines of the wrong sign give energy.
  const TemporaryFolder folder;
  const std::string text = case_with_lines(folder.path, 10.0, 1000.0, 600.0, -0.02);
  std::string told;
  const auto before = core::set_message_listener([&](core::MessageLevel, const std::string& said) { told += said; });
  const Case source = parse_case(text, folder.path);
  const auto forecast = forecast_lobes(source, enough_s);
  EXPECT_EQ(told, "");
  (void)refusal_of_run(source, {});
  (void)core::set_message_listener(before);
  EXPECT_TRUE(forecast);
  EXPECT_NE(told.find("gives energy"), std::string::npos) << told;
}

TEST(LobesForecast, WhatIsAskedForBesideTheChartCounts) {
  const auto rows = [](const std::string& text) { return expected_rows(parse_case(text, ".")).of_structure; };
  const std::string plain = with(cutter_case(), "count = 3", "count = 100");
  EXPECT_EQ(rows(plain), 300.0);
  EXPECT_EQ(rows(with(cutter_case(), "count = 3", "count = 800")), 1000.0);
  EXPECT_EQ(rows(with(plain, "count = 100", "count = 100\nmost_added = 20")), 120.0);
  EXPECT_EQ(rows(with(plain, "count = 100", "count = 100\ncompare = [\"zeroth_order\"]")), 600.0);
  EXPECT_GT(rows(plain + "[lobes.uncertainty]\nfrequency = 0.01\n"), 3.5 * 300.0) << "two rows a speed and more";
}

}  // namespace
}  // namespace thinwall::tests::lobes_forecast_test

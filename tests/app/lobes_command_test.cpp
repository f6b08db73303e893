// `thinwall lobes`: the same structure as a case, as a table of modes and as FRFs; operating points; bad input.

#include "tests/app/lobes_command.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <sstream>
#include <tuple>

#include "app/command_line.hpp"
#include "app/lobes_input.hpp"
#include "case/reader.hpp"
#include "core/atomic_file.hpp"
#include "io/frf/mat_response.hpp"
#include "io/results/csv_table.hpp"
#include "tests/case/case_text.hpp"
#include "tests/processor_time.hpp"

namespace thinwall::tests::lobes_command_test {

namespace {

void expect_refused(const Outcome& outcome, int code, const std::string& part) {
  EXPECT_EQ(outcome.code, code) << outcome.err;
  const auto first = outcome.err.find("thinwall: ");  // one message; beneath it perhaps the line that it is about
  EXPECT_EQ(first, 0U) << outcome.err;
  EXPECT_EQ(outcome.err.find("\nthinwall: "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.out, "");
}

TEST_F(LobesCommand, ACaseATableOfModesAndFrfsOfEveryQuantityGiveOneChart) {
  ASSERT_EQ(lobes({path("modes.csv"), "--tool", path("tool.toml")}).code, 0);
  const double depth = summary()["lobes"][0]["minimum_depth_m"];
  EXPECT_GT(depth, 1e-4);
  const double stiffness = 0.03993 * std::pow(2.0 * std::numbers::pi * 922.0, 2);
  std::ostringstream modes;
  modes.precision(17);
  modes << "[[tool.modes]]\nfrequency = \"922 Hz\"\ndamping_ratio = 0.011\nstiffness = \"" << stiffness
        << " N/m\"\ndirection = \"x\"\n";
  write("case.toml", tool_toml + modes.str());
  ASSERT_EQ(lobes({path("case.toml")}).code, 0);
  EXPECT_NEAR(summary()["lobes"][0]["minimum_depth_m"].get<double>() / depth, 1.0, 1e-12);
  ASSERT_EQ(frf(path("tip.csv")).code, 0);
  EXPECT_NEAR(summary()["lobes"][0]["minimum_depth_m"].get<double>() / depth, 1.0, 2e-4);
  write_frf("mobility.csv", 1, 1.0);
  ASSERT_EQ(frf("x=" + path("mobility.csv"), {}, "mobility", "m/s/N").code, 0);
  EXPECT_NEAR(summary()["lobes"][0]["minimum_depth_m"].get<double>() / depth, 1.0, 2e-4);
}

/// An FRF whose lowest lines are an integrator's noise gives the chart of the band in which it is worth something.
TEST_F(LobesCommand, LinesOfAnIntegratorsNoiseAreLeftOutAndTold) {
  write_integrated("whole.csv", 0.0);
  write_integrated("band.csv", 100.0);
  const std::vector<std::string> few{"--set", "lobes.count=8", "--set", "lobes.most_added=0"};
  ASSERT_EQ(frf(path("band.csv"), few).code, 0);
  const auto band = summary()["lobes"][0];
  ASSERT_EQ(frf(path("whole.csv"), few).code, 0);
  const auto whole = summary()["lobes"][0];
  EXPECT_NEAR(whole["minimum_depth_m"].get<double>() / band["minimum_depth_m"].get<double>(), 1.0, 2e-3);
  EXPECT_LT(whole["error_estimate_relative"].get<double>(), 0.02);
  EXPECT_FALSE(whole.contains("below_first_resonance"));
}

/// The lines are fitted once; a row follows from the fit and from sums over what the lines leave of it.
TEST_F(LobesCommand, ASpeedOfAFileOfThousandsOfLinesTakesHundredthsOfASecond) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, 0.005);
  std::ostringstream text;
  for (int hz = 100; hz <= 5000; ++hz) {
    const double r = hz / 850.0, q = hz / 1650.0;
    const double real = noise(random), imaginary = noise(random);
    const std::complex<double> H = (1.0 / (2e7 * std::complex<double>(1.0 - r * r, 0.06 * r)) +
                                    1.0 / (4e7 * std::complex<double>(1.0 - q * q, 0.05 * q))) *
                                   std::complex<double>(1.0 + real, imaginary);
    text << hz << ',' << H.real() << ',' << H.imag() << '\n';
  }
  write("long.csv", text.str());
  const auto seconds = [&](const std::string& count) {
    const double before = processor_seconds();
    EXPECT_EQ(frf(path("long.csv"), {"--fresh", "--set", "lobes.count=" + count, "--set", "lobes.most_added=0"}).code,
              0);
    return processor_seconds() - before;
  };
  const double few = seconds("4");
  EXPECT_LT((seconds("24") - few) / 20.0, 0.05);
}

TEST_F(LobesCommand, TheBandOfAMeasuredFrfIsBoundedByItsKeys) {
  write_integrated("whole.csv", 0.0);
  const auto lines_of = [&](const std::vector<std::string>& overrides) {
    const Case source = lobes_case({{path("whole.csv")}, path("tool.toml"), overrides, "receptance", "m/N", ""});
    const setup::FrfContent& content = *source.tool->measured.at(0).content;
    return std::tuple(content.frf.axis.hz(0), content.frf.axis.hz(content.frf.axis.size() - 1),
                      content.warnings.empty() ? "" : content.warnings.at(0));
  };
  const auto [believed, highest, left_out] = lines_of({});
  EXPECT_GT(believed, 10.0);
  EXPECT_LT(believed, 50.0);
  EXPECT_EQ(highest, 2400.0);
  EXPECT_NE(left_out.find("are left out, for neighbouring lines scatter"), std::string::npos) << left_out;
  const auto [from, to, told] = lines_of({"tool.measured[0].from=150 Hz", "tool.measured[0].to=2 kHz"});
  EXPECT_EQ(from, 150.0);
  EXPECT_EQ(to, 2000.0);
  EXPECT_EQ(told, "") << "what is not believed lies beyond the bound";
  const auto [first, last, doubt] = lines_of({"tool.measured[0].from=0 Hz"});
  EXPECT_EQ(first, 0.0) << "the user knows better";
  EXPECT_EQ(last, 2400.0);
  EXPECT_NE(doubt.find("are used, but hardly to be believed"), std::string::npos) << doubt;
  expect_refused(frf(path("whole.csv"), {"--set", "tool.measured[0].from=9 kHz"}), 3, "no line");
  expect_refused(frf(path("whole.csv"), {"--set", "tool.measured[0].from=9 Hz", "--set", "tool.measured[0].to=8 Hz"}),
                 3, "must lie below the last");
}

TEST_F(LobesCommand, TheResolvedCaseOfAnFrfCanBeRunAgain) {
  ASSERT_EQ(frf(path("tip.csv"), {"--set", "lobes.count=2"}).code, 0);
  const double depth = summary()["lobes"][0]["minimum_depth_m"];
  const Case again = read_case(temporary.path / "results" / "case.resolved.toml");
  ASSERT_EQ(again.tool->measured.size(), 1U);
  EXPECT_EQ(again.lobes->count, 2);
  EXPECT_EQ(read_case(temporary.path / "results" / "case.toml").tool->measured[0].file, temporary.path / "tip.csv");
  ASSERT_EQ(lobes({path("results") + "/case.resolved.toml"}).code, 0);
  EXPECT_EQ(summary()["lobes"][0]["minimum_depth_m"].get<double>(), depth);
}

TEST_F(LobesCommand, EntriesOfTheFrfMatrixAreNamedBeforeTheFile) {
  const LobesInput input{
      {"x=" + path("tip.csv"), "yx=" + path("tip.csv")}, path("tool.toml"), {}, "receptance", "m/N", ""};
  const Case source = lobes_case(input);
  ASSERT_EQ(source.tool->measured.size(), 2U);
  EXPECT_EQ(source.tool->measured[0].response, "tool.x");
  EXPECT_EQ(source.tool->measured[1].response, "tool.y");
  EXPECT_EQ(source.tool->measured[1].force, "tool.x");
  EXPECT_EQ(source.name, "tip");
}

/// Whatever the name of a MAT file, it is none of lines of text, and says itself what it holds.
TEST_F(LobesCommand, AMatFileIsKnownByItsContent) {
  io::MeasuredResponse tip;
  tip.response.axis = dynamics::linear_axis(100.0, 2000.0, 400);
  tip.response.responses = tip.response.forces = {{"tool", Eigen::Vector3d::UnitX(), dynamics::DofKind::translation}};
  for (const double hz : tip.response.axis.hz)
    tip.response.H.push_back(Eigen::MatrixXcd::Constant(
        1, 1, 1.0 / (1.3e6 * std::complex<double>(1.0 - std::pow(hz / 922.0, 2), 0.022 * hz / 922.0))));
  io::write_mat_response(temporary.path / "tip.dat", tip);
  const Case source = lobes_case({{path("tip.dat")}, path("tool.toml"), {}, "", "", ""});
  ASSERT_EQ(source.tool->measured.size(), 1U);
  ASSERT_TRUE(source.tool->measured[0].content);
  EXPECT_EQ(source.tool->measured[0].content->frf.H(7), tip.response.H[7](0, 0));
  const Outcome stated = frf(path("tip.dat"), {}, "accelerance", "m/s^2/N");
  EXPECT_NE(stated.code, 0);
  EXPECT_NE(stated.err.find("holds receptances in m/N"), std::string::npos) << stated.err;
}

TEST_F(LobesCommand, WhatMovesIsPutBehindTheToolsOwnAndTakesSet) {
  write("own.toml", tool_toml +
                        "[[tool.modes]]\nfrequency = \"400 Hz\"\ndamping_ratio = 0.02\nstiffness = \"2e6 N/m\"\n"
                        "direction = \"y\"\n");
  write("modes.csv", "frequency_hz,damping_ratio,stiffness,direction\n922.1,0.011,1.3e6,-x\n1300,0.012,2.1e6,y\n");
  const Case source =
      lobes_case({{path("modes.csv")}, path("own.toml"), {"tool.modes[2].stiffness=3e6 N/m"}, "", "", ""});
  const auto& modes = source.tool->modes;
  ASSERT_EQ(modes.size(), 3U);
  EXPECT_EQ(modes[0].frequency_hz, 400.0);
  EXPECT_EQ(modes[1].frequency_hz, 922.1) << "to the last bit";
  EXPECT_EQ(modes[1].damping_ratio, 0.011);
  EXPECT_EQ(modes[1].stiffness, 1.3e6);
  EXPECT_EQ(modes[1].direction, -Eigen::Vector3d::UnitX());
  EXPECT_EQ(modes[2].stiffness, 3e6);
  write("whole.toml", source.source);
  const Case again = read_case(temporary.path / "whole.toml");
  ASSERT_EQ(again.tool->modes.size(), 3U);
  EXPECT_EQ(again.tool->modes[2].stiffness, 2.1e6) << "the text is without --set";
}

TEST_F(LobesCommand, OperatingPointsAreAnsweredFromPolesWithTheMultiplier) {
  const Outcome outcome = lobes({path("modes.csv"), "--tool", path("tool.toml"), "--at", "14000 rpm, 0.5 mm", "--at",
                                 "12000rpm,5mm", "--set", "lobes.count=30"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto points = summary()["operating_points"];
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0]["stable"], true);
  EXPECT_LT(points[0]["multiplier_modulus"].get<double>(), 1.0);
  EXPECT_GT(points[0]["depth_margin_m"].get<double>(), 0.0);
  EXPECT_EQ(points[1]["stable"], false);
  EXPECT_GT(points[1]["multiplier_modulus"].get<double>(), 1.0);
  EXPECT_LT(points[1]["depth_margin_m"].get<double>(), 0.0);
  for (const auto* key : {"chart", "boundary_below_rpm", "boundary_above_rpm", "chatter_frequency_hz", "bifurcation",
                          "depth_margin_relative", "depth_margin_at_limit", "depth_error_estimate_relative",
                          "multiplier_error_estimate_relative", "status"})
    EXPECT_TRUE(points[1].contains(key)) << key;
  EXPECT_NE(outcome.out.find("14000 rpm, 0.500 mm, tool: stable, |mu| 0."), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("12000 rpm, 5.000 mm, tool: UNSTABLE"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("\n    pockets "), std::string::npos);
}

TEST_F(LobesCommand, FromSamplesTheMultiplierIsNullAndTheRestAgrees) {
  const std::vector<std::string> at{"--at", "13000 rpm, 1.5 mm", "--set", "lobes.count=15"};
  std::vector<std::string> words{path("modes.csv"), "--tool", path("tool.toml")};
  words.insert(words.end(), at.begin(), at.end());
  ASSERT_EQ(lobes(words).code, 0);
  const auto poles = summary()["operating_points"][0];
  ASSERT_EQ(frf(path("tip.csv"), at).code, 0);
  const auto samples = summary()["operating_points"][0];
  EXPECT_TRUE(samples["multiplier_modulus"].is_null());
  EXPECT_EQ(samples["stable"], poles["stable"]);
  EXPECT_NEAR(samples["depth_margin_m"].get<double>(), poles["depth_margin_m"].get<double>(), 1e-6);
  for (const auto* key : {"boundary_below_rpm", "boundary_above_rpm"}) {
    ASSERT_EQ(samples[key].is_null(), poles[key].is_null()) << key;
    if (!poles[key].is_null()) {
      EXPECT_NEAR(samples[key].get<double>() / poles[key].get<double>(), 1.0, 1e-4) << key;
    }
  }
}

TEST_F(LobesCommand, AnOperatingPointThatIsNoneIsWrongUse) {
  for (const auto* text :
       {"5000 rpm", "5000 rpm 0.5 mm", "5000 rpm, 0.5 mm, 3", "5000, 0.5 mm", "5000 rpm, 0.5 Hz", "0.5 mm, 5000 rpm",
        "0 rpm, 0.5 mm", "-5000 rpm, 0.5 mm", "5000 rpm, 0 mm", "5000 rpm, -1 mm", ", ", "5000 rpm, nan mm",
        "fast, deep", "1e300 rpm, 0.5 mm", "0.5 rpm, 0.5 mm", "5000 rpm, 1e-300 m"}) {
    expect_refused(lobes({path("modes.csv"), "--tool", path("tool.toml"), std::string("--at=") + text}), 2, "--at");
  }
  expect_refused(lobes({path("modes.csv"), "--tool", path("tool.toml"), "--at", "9000 rpm, 11 mm"}), 3,
                 "--at: operating point at 11 mm: deeper than the chart goes");
}

TEST_F(LobesCommand, WordsThatDoNotGoTogetherAreWrongUse) {
  expect_refused(lobes({path("tip.csv"), "--tool", path("tool.toml")}), 2, "--quantity");
  expect_refused(lobes({path("tip.csv"), "--quantity", "receptance", "--unit", "m/N"}), 2, "--tool");
  expect_refused(lobes({path("tool.toml"), "--tool", path("tool.toml")}), 2, "is a case");
  expect_refused(frf(path("modes.csv")), 2, "table of modes");
  expect_refused(frf("x=" + path("tip.csv"), {"modes=" + path("tip.csv")}), 4, "modes=");
}

TEST_F(LobesCommand, FilesThatAreMissingOrWrongAreRefused) {
  expect_refused(frf(path("absent.csv")), 4, "absent.csv");
  expect_refused(lobes({path("modes.csv"), "--tool", path("absent.toml")}), 4, "absent.toml");
  expect_refused(lobes({path("absent.toml")}), 3, "no case");
  expect_refused(lobes({path("tool.toml")}), 3, "a case holds a part");
  expect_refused(frf(path("tip.csv"), {}, "mobility", "m/N"), 3,
                 "thinwall: --unit: \"m/N\" is a unit of receptance, but");
  expect_refused(frf(path("tip.csv"), {}, "flexibility", "m/N"), 3, "thinwall: --quantity: \"flexibility\" is none of");
  expect_refused(frf(path("tip.csv"), {"y=" + path("tip.csv")}, "flexibility", "m/N"), 3, "--quantity: ");
  expect_refused(frf(path("tip.csv"), {"--frequency-unit", "rpm"}), 3, "--frequency-unit: \"rpm\" is none of");
  expect_refused(frf(path("tip.csv"), {"x=" + path("tip.csv")}), 3, "the same entry");
  write_frf("narrow.csv", 0, 1.0, 1200.0);
  expect_refused(frf(path("narrow.csv")), 3, "the harmonic at");
}

TEST_F(LobesCommand, ATableOfModesThatNoStructureHasIsRefusedWithItsLine) {
  const auto refused = [&](const std::string& table, const std::string& part) {
    write("modes.csv", table);
    expect_refused(lobes({path("modes.csv"), "--tool", path("tool.toml")}), 4, part);
  };
  const std::string header = "frequency_hz,damping_ratio,stiffness,direction\n";
  refused(header + "922,-0.011,1e6,x\n", "modes.csv:2: damping_ratio = -0.011, must be above 0");
  refused(header + "922,0,1e6,x\n", "damping_ratio = 0");
  refused(header + "922,1.1,1e6,x\n", "below 1");
  refused(header + "-922,0.01,1e6,x\n", "frequency_hz");
  refused(header + "922,0.01,0,x\n", "stiffness");
  refused(header + "922,0.01,1e6,u\n", "modes.csv:2");
  refused(header + "922,0.01,1e6\n", "modes.csv:2");
  refused("frequency_hz,damping_ratio,direction\n922,0.01,x\n", "no column \"stiffness\"");
  refused("frequency_hz,damping_ratio,stiffness,mass\n922,0.01,1e6,1\n", "keep one");
}

TEST_F(LobesCommand, ToolsCutsAndSpeedsThatCannotBeAreRefusedWithTheirKey) {
  const auto refused = [&](const std::string& from, const std::string& to, const std::string& part) {
    write("tool.toml", with(tool_toml, from, to));
    expect_refused(lobes({path("modes.csv"), "--tool", path("tool.toml")}), 3, part);
  };
  refused("teeth = 2", "teeth = 0", "tool.teeth");
  refused("radial_depth = \"1 mm\"", "radial_depth = \"0 mm\"", "cutting.radial_depth");
  refused("radial_depth = \"1 mm\"", "radial_depth = \"10.1 mm\"", "more than the tool's diameter");
  refused("from = \"9000 rpm\"", "from = \"-9000 rpm\"", "lobes.from");
  refused("from = \"9000 rpm\"", "from = \"0 rpm\"", "lobes.from");
  refused("from = \"9000 rpm\"", "from = \"16000 rpm\"", "must lie below the highest");
  refused("count = 8", "count = 1", "lobes.count");
  refused("teeth = 2", "teeth = 2\nhelices = \"90 deg\"", "tool.helices");
  refused("teeth = 2", "teeth = 2\npitches = [\"170 deg\", \"180 deg\"]", "350 deg");
  refused("teeth = 2", "teeth = 2\npitches = [\"360 deg\"]", "1 values for 2 teeth");
}

TEST_F(LobesCommand, HelixAndPitchesGoWithFrfsAsWithModes) {
  for (const char* key : {"helices = \"30 deg\"", "pitches = [\"170 deg\", \"190 deg\"]"}) {
    write("tool.toml", with(tool_toml, "teeth = 2", std::string("teeth = 2\n") + key));
    ASSERT_EQ(lobes({path("modes.csv"), "--tool", path("tool.toml")}).code, 0) << key;
    const double depth = summary()["lobes"][0]["minimum_depth_m"];
    ASSERT_EQ(frf(path("tip.csv")).code, 0) << key;
    EXPECT_NEAR(summary()["lobes"][0]["minimum_depth_m"].get<double>() / depth, 1.0, 2e-4) << key;
  }
}

}  // namespace
}  // namespace thinwall::tests::lobes_command_test

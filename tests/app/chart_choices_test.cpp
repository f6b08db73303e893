// What a chart is asked for besides its limits: methods, map, uncertainties, the machine; and what is refused.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/case_run.hpp"
#include "case/problem.hpp"
#include "case/reader.hpp"
#include "case/schema/schema.hpp"
#include "core/atomic_file.hpp"
#include "io/results/csv_table.hpp"
#include "milling/chart/lobe_method.hpp"
#include "report/lobes/lobes_answers.hpp"
#include "tests/app/command_call.hpp"
#include "tests/core/temporary_folder.hpp"

namespace thinwall::tests::chart_choices_test {

using namespace setup;
using namespace cases;
using namespace report;
using namespace app;

namespace {

/// The one-DOF benchmark: two teeth, K_t 600 N/mm², a tenth of the diameter.
std::string mill(const std::string& tool = "", const std::string& cutting = "", const std::string& rest = "") {
  return "[tool]\nteeth = 2\ndiameter = \"10 mm\"\nlength = \"10 mm\"\n" + tool +
         "[[tool.modes]]\nfrequency = \"922 Hz\"\ndamping_ratio = 0.011\nstiffness = \"1340049.648 N/m\"\n"
         "direction = \"x\"\n"
         "[cutting]\nradial_depth = \"1 mm\"\nfeed_direction = \"x\"\nKt = \"600 N/mm^2\"\nKr = \"200 N/mm^2\"\n" +
         cutting + "[lobes]\nfrom = \"9000 rpm\"\nto = \"16000 rpm\"\ncount = 8\n" + rest;
}

const std::string feed = "feed_per_tooth = \"0.1 mm\"\n";

void expect_problem(const std::string& text, const std::string& key, const std::string& part) {
  try {
    (void)parse_case(text, ".");
    ADD_FAILURE() << "accepted, though " << part;
  } catch (const CaseError& error) {
    ASSERT_EQ(error.problems.size(), 1U) << error.what();
    const std::string& found = error.problems[0].text;
    EXPECT_EQ(found.find(key + ":"), 0U) << found;
    EXPECT_NE(found.find(part), std::string::npos) << found;
    EXPECT_EQ(found.find('\n'), std::string::npos);
    EXPECT_GT(error.problems[0].line, 0);
  }
}

class ChartChoices : public testing::Test {
 protected:
  /// Runs `thinwall lobes` on the case; returns what it prints.
  std::string run(const std::string& text, std::vector<std::string> more = {}) {
    core::write_file_atomically(temporary.path / "case.toml", text);
    std::vector<std::string> words{"lobes", path("case.toml"), "--out", path("results"), "-q"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = call(std::move(words), run_case);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    summary = nlohmann::json::parse(core::read_file(temporary.path / "results" / "summary.json"));
    return outcome.out;
  }
  [[nodiscard]] std::string path(const std::string& name) const { return (temporary.path / name).string(); }
  [[nodiscard]] std::vector<double> column(const std::string& file, const std::string& name) const {
    const auto csv = temporary.path / "results" / "lobes" / file;
    return io::numbers(io::read_csv(csv), name, csv);
  }

  TemporaryFolder temporary;
  nlohmann::json summary;
};

TEST(ChartMethods, AreThoseOfTheLibrary) {
  std::vector<std::string> names;
  for (const auto method : milling::all_methods()) names.push_back(milling::name(method));
  EXPECT_EQ(choices(*find_key(case_schema(), "lobes.method")), names);
  EXPECT_EQ(choices(*find_key(case_schema(), "lobes.compare")), names);
}

TEST_F(ChartChoices, TheChartComesFromItsMethodAndIsComparedWithOthers) {
  const std::string report = run(mill("", "",
                                      "method = \"semi_discretization_1\"\nsteps_per_period = 60\n"
                                      "compare = [\"direct\", \"zeroth_order\"]\n"),
                                 {"--at", "14000 rpm, 0.5 mm"});
  const auto& chart = summary["lobes"][0];
  EXPECT_EQ(chart["method"], "semi-discretization of order 1, 60 steps a tooth period");
  const auto own = column("tool.csv", "limiting_depth_m");
  const auto direct = column("tool_direct.csv", "limiting_depth_m");
  ASSERT_EQ(own.size(), direct.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < own.size(); ++i) largest = std::max(largest, std::abs(direct[i] / own[i] - 1.0));
  EXPECT_EQ(chart["compared"][0]["name"], "direct");
  EXPECT_DOUBLE_EQ(chart["compared"][0]["largest_relative_difference"], largest);
  // The chart's own estimate covers its distance from the exact one, and is far below that of the mean cut.
  EXPECT_GT(largest, 1e-4);
  EXPECT_LE(largest, chart["error_estimate_relative"].get<double>() * (1.0 + largest) + 1e-4);
  EXPECT_GT(chart["compared"][1]["largest_relative_difference"], 10.0 * largest);
  EXPECT_NE(report.find("zeroth order: differs by up to"), std::string::npos) << report;
  EXPECT_TRUE(summary["operating_points"][0]["sensitivities"].empty()) << "they are the direct method's";
}

TEST_F(ChartChoices, TheMapPassesOneWhereTheChartDoes) {
  (void)run(mill("", "", "map_depths = 60\nmost_added = 0\n"));  // the map has the even speeds
  const auto& map = summary["lobes"][0]["map"];
  EXPECT_EQ(map["speeds_not_converged"], 0);
  EXPECT_LE(map["error_estimate"].get<double>(), 1e-4);
  const auto limits = column("tool.csv", "limiting_depth_m");
  const auto depth = column("tool_map.csv", "depth_m");
  const auto modulus = column("tool_map.csv", "multiplier_modulus");
  ASSERT_EQ(depth.size(), 60 * limits.size());
  EXPECT_EQ(depth.back(), *std::ranges::max_element(limits));
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const double limit = limits[i / 60];
    if (depth[i] < 0.999 * limit) {
      EXPECT_LT(modulus[i], 1.0) << i;
    }
    if (depth[i] > 1.001 * limit && depth[i] < 1.1 * limit) {
      EXPECT_GT(modulus[i], 1.0) << i;
    }
  }
}

TEST_F(ChartChoices, RobustDepthsStandBesideTheLimits) {
  const std::string report = run(mill("", feed,
                                      "[lobes.uncertainty]\nfrequency = 0.01\ndamping_ratio = 0.2\n"
                                      "receptance = \"5 %\"\ncoefficients = 0.1\n"));
  const auto limits = column("tool.csv", "limiting_depth_m");
  const auto robust = column("tool.csv", "robust_depth_m");
  const auto uncertainty = column("tool.csv", "relative_uncertainty");
  for (std::size_t i = 0; i < limits.size(); ++i) {
    EXPECT_GT(uncertainty[i], 0.1) << "damping and coefficients alone make more";
    EXPECT_LT(robust[i], 0.8 * limits[i]);
  }
  const auto& chart = summary["lobes"][0]["robust"];
  EXPECT_EQ(chart["confidence"], 2.0);
  EXPECT_EQ(chart["minimum_depth_m"], *std::ranges::min_element(robust));
  EXPECT_LT(chart["best_pockets"][0]["removal_rate_cm3_per_min"].get<double>(),
            summary["lobes"][0]["best_pockets"][0]["removal_rate_cm3_per_min"].get<double>());
  EXPECT_NE(report.find("robust "), std::string::npos) << report;
}

TEST_F(ChartChoices, SensitivitiesAreListedLargestFirstAndNamedInWords) {
  const std::string report = run(mill("", "spindle_speed = \"12000 rpm\"\n"), {"--at", "14000 rpm, 0.5 mm"});
  for (const auto& list :
       {summary["lobes"][0]["at_case_speed"]["sensitivities"], summary["operating_points"][0]["sensitivities"]}) {
    ASSERT_EQ(list.size(), 6U);
    double coefficients = 0.0, receptance = 0.0;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const double value = list[i]["sensitivity"];
      if (i > 0) {
        EXPECT_LE(std::abs(value), std::abs(list[i - 1]["sensitivity"].get<double>()));
      }
      if (list[i]["mode_frequency_hz"].is_null()) coefficients += value;
      if (list[i]["parameter"] == "receptance") receptance += value;
    }
    // The limit goes with the reciprocal of all coefficients, and of the receptance of all modes.
    EXPECT_NEAR(coefficients, -1.0, 1e-6);
    EXPECT_NEAR(receptance, -1.0, 1e-6);
  }
  EXPECT_NE(report.find("of the mode at 922.0 Hz"), std::string::npos) << report;
}

TEST(ChartAnswers, NameTheTwoParametersThatMatterMost) {
  const auto entry = [](const char* parameter, std::optional<double> hz, double value) {
    return SensitivitySummary{.parameter = parameter, .mode_frequency_hz = hz, .sensitivity = value};
  };
  EXPECT_EQ(sensitivities_text({entry("damping_ratio", 412.0, 0.8), entry("K_t", {}, -0.5), entry("K_r", {}, 0.4)}),
            "    1 % more damping of the mode at 412.0 Hz raises the limit by 0.80 %\n"
            "    1 % more K_t lowers the limit by 0.50 %\n");
  EXPECT_EQ(sensitivities_text({entry("frequency", 412.0, -9.0), entry("K_t", {}, -0.5)}),
            "    a 1 % higher natural frequency of the mode at 412.0 Hz lowers the limit by 9.00 %\n");
  EXPECT_EQ(sensitivities_text({}), "");
}

TEST_F(ChartChoices, PocketsStayWithinTheMachine) {
  const std::string report = run(mill("", feed,
                                      "[machine]\nmax_spindle_speed = \"15500 rpm\"\nmax_power = \"30 W\"\n"
                                      "efficiency = 0.8\n"));
  const auto& pockets = summary["lobes"][0]["best_pockets"];
  // 24 W over K_t = 600 N/mm² remove 2.4 cm³ a minute: all else would be deeper than the spindle can drive.
  EXPECT_EQ(pockets[0]["limited_by"], "power");
  EXPECT_NEAR(pockets[0]["removal_rate_cm3_per_min"].get<double>(), 2.4, 1e-9);
  for (const auto& pocket : pockets) EXPECT_LE(pocket["spindle_speed_rpm"].get<double>(), 15500.0);
  EXPECT_NE(report.find("2.4 cm3/min, limited by power"), std::string::npos) << report;
  (void)run(mill("", feed, "depth_limit = \"0.2 mm\"\n"));
  EXPECT_EQ(summary["lobes"][0]["best_pockets"][0]["limited_by"], "depth_limit");
  (void)run(mill());
  EXPECT_TRUE(summary["lobes"][0]["best_pockets"][0]["removal_rate_cm3_per_min"].is_null());
}

TEST(ChartChoicesBad, MethodsAreRefusedForWhatTheyCannotTake) {
  const auto lobes = [](const std::string& lines) { return mill("", "", lines); };
  expect_problem(lobes("method = \"zeroth-order\"\n"), "lobes.method", "did you mean \"zeroth_order\"");
  expect_problem(lobes("compare = [\"semi_discretisation_1\"]\n"), "lobes.compare",
                 "did you mean \"semi_discretization_1\"");
  expect_problem(lobes("compare = \"direct\"\n"), "lobes.compare", "is lobes.method itself");
  expect_problem(lobes("compare = [\"zeroth_order\", \"zeroth_order\"]\n"), "lobes.compare", "twice");
  expect_problem(lobes("steps_per_period = 40\n"), "lobes.steps_per_period", "belongs to semi_discretization");
  expect_problem(lobes("harmonics = 8\nmethod = \"semi_discretization_0\"\n"), "lobes.harmonics",
                 "belongs to multi_frequency");
  expect_problem(lobes("method = \"full_discretization_1\"\nsteps_per_period = 2\n"), "lobes.steps_per_period", "3");
  expect_problem(lobes("method = \"multi_frequency\"\nharmonics = -1\n"), "lobes.harmonics", "0");
  const std::string helix = "helices = \"30 deg\"\n";
  const std::string pitches = "pitches = [\"170 deg\", \"190 deg\"]\n";
  EXPECT_NO_THROW((void)parse_case(mill(helix, "", "method = \"zeroth_order\"\n"), "."));
  expect_problem(mill(helix, "", "method = \"multi_frequency\"\n"), "lobes.method", "takes equal teeth without helix");
  expect_problem(mill(pitches, "", "compare = [\"zeroth_order\"]\n"), "lobes.compare", "takes equal teeth");
  const std::string power = "law = \"power\"\nexponents = 0.25\n" + feed;
  EXPECT_NO_THROW((void)parse_case(mill("", power, "method = \"zeroth_order\"\n"), "."));
  expect_problem(mill("runout = [\"10 um\", \"0 um\"]\n", power, "method = \"zeroth_order\"\n"), "lobes.method",
                 "takes equal teeth");
  expect_problem(mill("", "process_damping = \"1e4 N/m\"\n", "method = \"semi_discretization_2\"\n"), "lobes.method",
                 "without process damping");
}

TEST(ChartChoicesBad, AMeasuredToolHasNoPolesForThem) {
  const TemporaryFolder temporary;
  core::write_file_atomically(temporary.path / "tip.csv", "frequency_hz,real,imaginary\n1,1,0\n2,1,0\n");
  const auto measured = [&](const std::string& lines) {
    std::string text = mill("", "", lines);
    const auto from = text.find("[[tool.modes]]");
    text.replace(from, text.find("[cutting]") - from,
                 "[[tool.measured]]\nresponse = \"x\"\nforce = \"x\"\nfile = \"" +
                     (temporary.path / "tip.csv").string() + "\"\nquantity = \"receptance\"\nunit = \"m/N\"\n");
    return text;
  };
  EXPECT_NO_THROW((void)parse_case(measured(""), "."));
  expect_problem(measured("method = \"zeroth_order\"\n"), "lobes.method", "tool.measured has none");
  expect_problem(measured("compare = \"multi_frequency\"\n"), "lobes.compare", "tool.measured has none");
  expect_problem(measured("map_depths = 20\n"), "lobes.map_depths", "tool.measured has none");
  expect_problem(measured("[lobes.uncertainty]\nfrequency = 0.01\n"), "lobes.uncertainty", "tool.measured has none");
}

TEST(ChartChoicesBad, MapsAndUncertaintiesOutOfBoundsAreRefused) {
  for (const auto* count : {"0", "-5", "2001", "nan", "2.5"})
    expect_problem(mill("", "", std::string("map_depths = ") + count + "\n"), "lobes.map_depths", "");
  const auto uncertain = [](const std::string& lines) { return mill("", "", "[lobes.uncertainty]\n" + lines); };
  expect_problem(uncertain("frequency = -0.01\n"), "lobes.uncertainty.frequency", "at least 0");
  expect_problem(uncertain("coefficients = 1.5\n"), "lobes.uncertainty.coefficients", "at most 1");
  expect_problem(uncertain("frequency = 0.01\ndamping_ratio = nan\n"), "lobes.uncertainty.damping_ratio", "");
  for (const auto* confidence : {"0", "-2", "nan", "10"})
    expect_problem(uncertain(std::string("frequency = 0.01\nconfidence = ") + confidence + "\n"),
                   "lobes.uncertainty.confidence", "");
  expect_problem(uncertain("frequency = 0.4\n"), "lobes.uncertainty.frequency", "at most 50 % can be followed");
  expect_problem(uncertain("confidence = 2\n"), "lobes.uncertainty", "nothing is uncertain");
  expect_problem(mill("", "", "method = \"zeroth_order\"\n[lobes.uncertainty]\nfrequency = 0.01\n"),
                 "lobes.uncertainty", "belongs to lobes.method = \"direct\", but it is \"zeroth_order\"");
}

TEST(ChartChoicesBad, AMachineThatCannotBeIsRefused) {
  const auto machine = [](const std::string& lines) { return mill("", feed, "[machine]\n" + lines); };
  EXPECT_NO_THROW((void)parse_case(machine("max_power = \"15 kW\"\nmax_torque = \"40 N m\"\n"), "."));
  EXPECT_DOUBLE_EQ(parse_case(machine("max_power = \"15 kW\"\n"), ".").machine->max_power_W, 15e3);
  for (const auto* bad : {"\"0 W\"", "\"-3 kW\"", "nan", "\"3 N\""})
    expect_problem(machine(std::string("max_power = ") + bad + "\n"), "machine.max_power", "");
  expect_problem(machine("max_torque = \"0 N m\"\n"), "machine.max_torque", "above 0");
  expect_problem(machine("efficiency = 0\n"), "machine.efficiency", "above 0");
  expect_problem(machine("efficiency = 1.2\n"), "machine.efficiency", "at most 1");
  expect_problem(machine("min_spindle_speed = \"12000 rpm\"\nmax_spindle_speed = \"11000 rpm\"\n"),
                 "machine.min_spindle_speed", "below the highest");
  expect_problem(machine("max_spindle_speed = \"8000 rpm\"\n"), "machine", "beside the chart");
  expect_problem(mill("", "", "[machine]\nmax_power = \"3 kW\"\n"), "machine.max_power", "depends on the feed");
  std::string ball = mill("end = \"ball\"\n", feed, "[machine]\nmax_torque = \"3 N m\"\n");
  ball.replace(ball.find("\"1 mm\""), 6, "\"10 mm\"");
  expect_problem(ball, "machine.max_torque", "flat ends only");
}

}  // namespace
}  // namespace thinwall::tests::chart_choices_test

// Cuts that were made, on the command line: `lobes` judges them, `calibrate` learns from them, `validate` writes the
// page, `coefficients` fits mean forces.

#include <numbers>

#include "learning/edge_force_fit.hpp"
#include "learning/mean_force_fit.hpp"
#include "tests/app/lobes_command.hpp"

namespace thinwall::tests::observed_command_test {
namespace {

const std::string tool_case = R"([tool]
teeth = 2
diameter = "10 mm"
length = "5 mm"
[[tool.modes]]
frequency = "922 Hz"
damping_ratio = 0.03
stiffness = "1.34e6 N/m"
direction = "x"
[[tool.modes]]
frequency = "800 Hz"
damping_ratio = 0.03
stiffness = "2e6 N/m"
direction = "y"
[cutting]
radial_depth = "5 mm"
feed_direction = "x"
tool_axis = "z"
Kt = "600 N/mm^2"
Kr = "200 N/mm^2"
spindle_speed = "12000 rpm"
[lobes]
from = "9000 rpm"
to = "16000 rpm"
count = 8
most_added = 0
[lobes.uncertainty]
frequency = 0.02
coefficients = 0.1
)";

std::string cut(const std::string& rpm, const std::string& mm, const std::string& outcome) {
  return "[[observed]]\nspindle_speed = \"" + rpm + " rpm\"\ndepth = \"" + mm + " mm\"\nobserved = \"" + outcome +
         "\"\n";
}

class ObservedCommand : public LobesCommand {
 protected:
  [[nodiscard]] Outcome command(const std::vector<std::string>& words) const { return call(words, run_case); }
  [[nodiscard]] nlohmann::json chart() const { return summary()["lobes"][0]; }
};

TEST_F(ObservedCommand, JudgesEveryCut) {
  // A micrometre is stable and 5 mm are not, whatever the chart: a cut with the other outcome is predicted wrongly.
  write("case.toml", tool_case + cut("9500", "0.001", "stable") + cut("9500", "5", "chatter") +
                         cut("10000", "0.001", "chatter") + cut("10000", "5", "marginal"));
  const Outcome done = lobes({path("case.toml")});
  ASSERT_EQ(done.code, 0) << done.err;
  const auto observed = chart()["observed"];
  EXPECT_EQ(observed["prediction"]["right"], 2);
  EXPECT_EQ(observed["prediction"]["of"], 3);
  EXPECT_EQ(observed["chatter_wrong"], 1);
  EXPECT_EQ(observed["marginal"], 1);
  EXPECT_EQ(observed["textbook"]["right"], 2);
  EXPECT_EQ(observed["certainty"]["certainly_stable"], 2);
  EXPECT_EQ(observed["certainty"]["certainly_stable_that_chattered"], 1);
  EXPECT_EQ(observed["certainty"]["certainly_unstable"], 1);
  EXPECT_TRUE(observed["cuts"][3]["right"].is_null());
  EXPECT_LT(observed["cuts"][1]["depth_margin_m"].get<double>(), 0.0);
  EXPECT_NE(done.out.find("2 of 3 right"), std::string::npos) << done.out;
  const auto file = temporary.path / "results" / "lobes" / "tool_observed.csv";
  EXPECT_EQ(io::numbers(io::read_csv(file), "depth_m", file).size(), 4u);
}

TEST_F(ObservedCommand, HasTheMarginOfTheChart) {
  write("case.toml", tool_case + cut("12000", "0.2", "stable"));
  const Outcome done = lobes({path("case.toml")});
  ASSERT_EQ(done.code, 0) << done.err;
  const double limit = chart()["at_case_speed"]["limiting_depth_m"].get<double>();
  EXPECT_NEAR(chart()["observed"]["cuts"][0]["depth_margin_m"].get<double>(), limit - 0.2e-3, 2e-4 * limit);
}

TEST_F(ObservedCommand, LearnsFromCuts) {
  // Chatter below the predicted limit tells of harder material or another frequency, never of softer.
  write("case.toml", tool_case + cut("12000", "0.001", "stable"));
  ASSERT_EQ(lobes({path("case.toml")}).code, 0);
  const double limit_mm = 1e3 * chart()["at_case_speed"]["limiting_depth_m"].get<double>();
  std::string cuts;
  for (const double share : {0.85, 0.9, 0.95}) cuts += cut("12000", std::to_string(share * limit_mm), "chatter");
  write("case.toml", tool_case + cuts);
  const Outcome done =
      command({"calibrate", path("case.toml"), "--draws", "40", "--risk", "0.3", "--out", path("results"), "-q"});
  ASSERT_EQ(done.code, 0) << done.err;
  const auto learned = chart()["learned"];
  EXPECT_TRUE(learned["converged"].get<bool>());
  EXPECT_EQ(learned["draws"], 160);
  ASSERT_EQ(learned["parameters"].size(), 5u);
  EXPECT_EQ(learned["parameters"][4]["parameter"], "speed_exponent");
  EXPECT_EQ(learned["parameters"][4]["before"], 0.0);
  EXPECT_EQ(learned["parameters"][4]["relative_deviation_before"], 0.1) << "no more than that of the coefficients";
  EXPECT_EQ(learned["before"]["right"], 0);
  EXPECT_GT(learned["after"]["right"], 0);
  ASSERT_TRUE(learned.contains("next_cut"));
  EXPECT_LT(learned["next_cut"]["deviation_after"], learned["next_cut"]["deviation_before"]);
  ASSERT_TRUE(learned.contains("productive_cut"));
  EXPECT_LE(learned["productive_cut"]["chatter_probability"].get<double>(), 0.3);
  EXPECT_EQ(learned["next_cut"]["for_rpm"], 12000.0);
  for (const auto& row : learned["rows"]) EXPECT_LE(row["stable_95_m"], row["median_m"]);
}

TEST_F(ObservedCommand, ProposesNoCutBeyondTheMachine) {
  write("case.toml", tool_case + cut("12000", "0.3", "chatter") + "[machine]\nmax_spindle_speed = \"9500 rpm\"\n");
  const Outcome done = command({"calibrate", path("case.toml"), "--draws", "40", "--out", path("results"), "-q"});
  ASSERT_EQ(done.code, 0) << done.err;
  ASSERT_TRUE(chart()["learned"].contains("next_cut"));
  EXPECT_FALSE(chart()["learned"].contains("productive_cut"));
  EXPECT_LE(chart()["learned"]["next_cut"]["spindle_speed_rpm"].get<double>(), 9500.0);
  EXPECT_LE(chart()["learned"]["next_cut"]["chatter_probability"].get<double>(), 0.6);
  const Outcome outside =
      command({"calibrate", path("case.toml"), "--speed", "100 rpm", "--out", path("results"), "-q"});
  EXPECT_EQ(outside.code, 3);
  EXPECT_NE(outside.err.find("100 rpm lies outside the chart"), std::string::npos) << outside.err;
}

TEST_F(ObservedCommand, WritesThePageThatItThenFindsTrue) {
  for (const char* folder : {"cases/one", "cases/without", "cases/spaced", "cases/inline", "docs"})
    std::filesystem::create_directories(temporary.path / folder);
  write("cases/one/case.toml",
        "title = \"One\"\n" + tool_case + cut("9500", "0.001", "stable") + cut("9500", "4", "stable"));
  // Other spellings of the same key, as TOML allows them.
  write("cases/spaced/case.toml", tool_case + "[[ observed ]]" + cut("9500", "0.001", "stable").substr(12));
  write("cases/inline/case.toml",
        "observed = [{spindle_speed = \"9500 rpm\", depth = \"0.001 mm\", observed = \"stable\"}]\n" + tool_case);
  write("cases/one/README.md", "# One\n\n**Published.** All of it.\n\n**Assumed.** Nothing.\n");
  write("cases/without/case.toml", tool_case);
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(temporary.path);
  const Outcome written = command({"validate", "cases", "--page", path("docs/validation.md"), "-q"});
  const Outcome checked = command({"validate", "cases", "--page", path("docs/validation.md"), "--check", "-q"});
  write("docs/pictures/validation-one.svg", "<svg/>\n");
  const Outcome drawn = command({"validate", "cases", "--page", path("docs/validation.md"), "--check", "-q"});
  write("docs/validation.md", "other\n");
  const Outcome differs = command({"validate", "cases", "--page", path("docs/validation.md"), "--check", "-q"});
  write("cases/not-held.md", "## Not here\n\nA set without its depths.\n");
  const Outcome ended = command({"validate", "cases", "--page", path("docs/validation.md"), "-q"});
  const Outcome none = command({"validate", path("docs"), "-q"});
  std::filesystem::current_path(before);
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_TRUE(core::read_file(temporary.path / "docs/validation.md")
                  .ends_with("\n\n## Not here\n\nA set without its depths.\n"));
  EXPECT_EQ(written.code, 0) << written.err;
  EXPECT_NE(written.out.find("1 of 2 right"), std::string::npos) << written.out;
  EXPECT_NE(written.out.find("spaced "), std::string::npos) << written.out;
  EXPECT_NE(written.out.find("inline "), std::string::npos) << written.out;
  EXPECT_EQ(checked.code, 0) << checked.out;
  EXPECT_EQ(drawn.code, 6);
  EXPECT_NE(drawn.out.find("validation-one.svg differs"), std::string::npos) << drawn.out;
  EXPECT_EQ(differs.code, 6);
  EXPECT_EQ(none.code, 3);
  EXPECT_TRUE(std::filesystem::exists(temporary.path / "docs" / "pictures" / "validation-one.svg"));
}

TEST_F(ObservedCommand, FitsCoefficientsOfMeanForces) {
  const milling::CuttingCoefficients truth{7.5e8, 2.4e8, -1.1e8, 18e3, 22e3, -3e3};
  std::ostringstream mm, dynamometer;
  mm.precision(17);
  dynamometer.precision(17);
  mm << "feed_per_tooth_mm,depth_mm,force_feed_n,force_normal_n,force_axis_n\n";
  dynamometer << "feed_per_tooth_m,depth_m,force_feed_kn,force_normal_kn,force_axis_kn\n";
  for (const double feed : {0.03, 0.06, 0.09}) {
    const auto force = learning::mean_force_n(2, truth, {{0.0, std::numbers::pi}, 2e-3, feed * 1e-3});
    mm << feed << ",2," << force.x() << ',' << force.y() << ',' << force.z() << '\n';
    dynamometer << feed * 1e-3 << ",0.002," << -force.x() * 1e-3 << ',' << -force.y() * 1e-3 << ',' << -force.z() * 1e-3
                << '\n';
  }
  write("forces.csv", mm.str());
  write("part.csv", dynamometer.str());
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"coefficients", path("forces.csv"), "--teeth", "2"},
        {"coefficients", path("part.csv"), "--teeth", "2", "--on", "part"}}) {
    const Outcome done = command(words);
    ASSERT_EQ(done.code, 0) << done.err;
    for (const char* line : {"Kt  = \"750 N/mm^2\"", "Kr  = \"240 N/mm^2\"", "Ka  = \"-110 N/mm^2\"",
                             "Kte = \"18 N/mm\"", "Kre = \"22 N/mm\"", "# Kae = \"-3 N/mm\""})
      EXPECT_NE(done.out.find(line), std::string::npos) << done.out;
    // The table that is printed is one of a case, and is read as such.
    std::string with = tool_case;
    const std::string own = "Kt = \"600 N/mm^2\"\nKr = \"200 N/mm^2\"\n";
    with.replace(with.find("[cutting]\n"), 10, done.out);
    with.replace(with.find(own), own.size(), "");
    const cases::Case read = cases::parse_case(with, temporary.path);
    EXPECT_NEAR(read.cutting->Kt, truth.K_t, 1e-4 * truth.K_t);
    EXPECT_NEAR(read.cutting->Kte, truth.K_te, 1e-4 * truth.K_te);
    EXPECT_EQ(read.cutting->Kae, 0.0);
  }
  const Outcome reversed = command({"coefficients", path("part.csv"), "--teeth", "2"});
  EXPECT_EQ(reversed.code, 3);
  EXPECT_NE(reversed.err.find("K_t is -750 N/mm^2, must be above 0"), std::string::npos) << reversed.err;
  write("no_unit.csv", "feed_per_tooth_mm,depth_mm,force_feed,force_normal,force_axis\n0.1,1,1,1,1\n");
  const Outcome refused = command({"coefficients", path("no_unit.csv"), "--teeth", "2"});
  EXPECT_EQ(refused.code, 4);
  EXPECT_NE(refused.err.find("does not say its unit"), std::string::npos) << refused.err;
  write("one.csv", "feed_per_tooth_mm,depth_mm,force_feed_n,force_normal_n,force_axis_n\n0.1,1,1,1,1\n0.1,1,1,1,1\n");
  const Outcome singular = command({"coefficients", path("one.csv"), "--teeth", "2"});
  EXPECT_EQ(singular.code, 3);
  EXPECT_NE(singular.err.find("twice the feed per tooth"), std::string::npos) << singular.err;
}

TEST_F(ObservedCommand, RefusesMeanForcesOfATallCutAndOfABall) {
  const std::string columns = "feed_per_tooth_mm,depth_mm,force_feed_n,force_normal_n,force_axis_n\n";
  write("forces.csv", columns + "0.03,2,-20,30,-5\n0.06,2,-35,55,-9\n0.09,2,-50,80,-13\n");
  const auto refused = [&](const std::string& tool) {
    write("tool.toml", "[tool]\nteeth = 2\ndiameter = \"10 mm\"\n" + tool);
    const Outcome done = command({"coefficients", path("forces.csv"), "--tool", path("tool.toml")});
    EXPECT_EQ(done.code, 3) << done.out;
    return done.err;
  };
  const std::string length = "length = \"20 mm\"\n";
  for (const std::string end : {"end = \"ball\"\n", "end = \"bull_nose\"\ncorner_radius = \"2 mm\"\n"})
    EXPECT_NE(refused(length + end).find("mean forces are those of a cylinder"), std::string::npos) << end;
  EXPECT_NE(refused("length = \"1 mm\"\n").find("2 mm deep, must be at most the 1 mm"), std::string::npos);
  const std::string runout = "runout = [\"9 mm\", \"-9 mm\"]\n";
  EXPECT_NE(refused(length + runout).find("runout"), std::string::npos);
}

TEST_F(ObservedCommand, FitsForcesOverTheAngleWithTheRunoutOfATool) {
  const milling::CuttingCoefficients truth{7.5e8, 2.4e8, -1.1e8, 18e3, 22e3, 3e3};
  write("tool.toml", "[tool]\nteeth = 2\ndiameter = \"10 mm\"\nlength = \"20 mm\"\nhelices = [\"30 deg\"]\n");
  milling::Cutter cutter;
  cutter.teeth = 2;
  cutter.diameter_m = 0.01;
  cutter.helices_rad = {std::numbers::pi / 6.0, std::numbers::pi / 6.0};
  cutter.runout_m = {5e-6, -5e-6};
  std::ostringstream text;
  text.precision(17);
  text << "feed_per_tooth_mm,depth_mm,angle_deg,force_feed_n,force_normal_n,force_axis_n\n";
  for (const double feed : {0.04, 0.08}) {
    const learning::ForceRecord cut{{0.0, std::numbers::pi}, 2e-3, feed * 1e-3, {}, {}};
    for (int degrees = 0; degrees < 360; degrees += 10) {
      const auto force = learning::edge_force_n(cutter, truth, cut, degrees * std::numbers::pi / 180.0);
      text << feed << ",2," << degrees << ',' << force.x() << ',' << force.y() << ',' << force.z() << '\n';
    }
  }
  write("angles.csv", text.str());
  const Outcome done = command({"coefficients", path("angles.csv"), "--tool", path("tool.toml")});
  ASSERT_EQ(done.code, 0) << done.err;
  for (const char* line :
       {"# 2 cuts, 209 degrees of freedom", "Kt  = \"750 N/mm^2\"", "Kr  = \"240 N/mm^2\"", "Ka  = \"-110 N/mm^2\"",
        "Kte = \"18 N/mm\"", "Kre = \"22 N/mm\"", "Kae = \"3 N/mm\"", "runout = [\"5 um\", \"-5 um\"]"})
    EXPECT_NE(done.out.find(line), std::string::npos) << done.out;
  const Outcome without = command({"coefficients", path("angles.csv"), "--teeth", "2"});
  EXPECT_EQ(without.code, 2);
  EXPECT_NE(without.err.find("--diameter is missing"), std::string::npos) << without.err;
  const Outcome vast = command({"coefficients", path("angles.csv"), "--teeth", "2", "--diameter", "1e300 m"});
  EXPECT_EQ(vast.code, 2);
  EXPECT_NE(vast.err.find("1e+300 m is no length in machining"), std::string::npos) << vast.err;
  write("tool.toml", "title = \"None\"\n");
  const Outcome no_tool = command({"coefficients", path("angles.csv"), "--tool", path("tool.toml")});
  EXPECT_EQ(no_tool.code, 3);
  EXPECT_NE(no_tool.err.find("there is no [tool]"), std::string::npos) << no_tool.err;
  EXPECT_EQ(command({"coefficients", path("angles.csv")}).code, 2);
}

}  // namespace
}  // namespace thinwall::tests::observed_command_test

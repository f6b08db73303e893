// Contacts of a whole run: found again from the assembly that the program computed with them, pressed balls, and
// kernels that no inverse exists of.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <filesystem>
#include <limits>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/frf/response_csv.hpp"
#include "report/summary/summary_json.hpp"
#include "report/terminal_report.hpp"
#include "tests/measurement/synthetic_measurement.hpp"
#include "tests/system/run_in_folder.hpp"

namespace thinwall::tests::contact_test {

using namespace setup;
using namespace cases;
using namespace report;

namespace {

namespace fs = std::filesystem;

/// A wall on its foot, a robot of a mode along x and one along y.
const std::string wall = R"([part]
length = "150 mm"
height = "80 mm"
thickness = "5 mm"
[part.material]
youngs_modulus = "70 GPa"
poisson_ratio = 0.33
density = "2700 kg/m^3"
[part.mesh]
element_size = "20 mm"
[[part.supports]]
on = "z_min"
[points.P]
at = [1.0, 0.4, 0.8]
[points.Q]
at = [1.0, 0.7, 0.9]
[reduction]
modes = 15
check_frequencies = 0
[damping]
ratio = 0.01
[response]
from = "10 Hz"
to = "1600 Hz"
lines = 637
)";

const std::string robot = R"([robot]
model = "modes"
modes = [
  { frequency = "35 Hz", damping_ratio = 0.05, stiffness = "1.5e6 N/m", direction = "x" },
  { frequency = "90 Hz", damping_ratio = 0.04, stiffness = "2.5e6 N/m", direction = "y" },
  { frequency = "300 Hz", damping_ratio = 0.03, stiffness = "8e6 N/m", direction = "x" },
]
)";

std::string contact(const std::string& lines) {
  return "[[contacts]]\npart = \"P\"\n" + lines;
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

/// An entry of a run's FRFs as a file, and the table of the case that names it.
std::string measured(const fs::path& from, const std::string& frf, const fs::path& to, const std::string& table,
                     const std::string& response, const std::string& force) {
  const dynamics::ResponseModel all = io::read_response(from / "frf" / (frf + ".csv"));
  const std::string file = frf + "_" + response + "_" + force + ".csv";
  write_measurement(to / file, "# computed\n", all.axis, dynamics::entry(all, response, force));
  return "[[" + table + "]]\nresponse = \"" + response + "\"\nforce = \"" + force + "\"\nfile = \"" + file +
         "\"\nquantity = \"receptance\"\nunit = \"m/N\"\n";
}

std::string held(const fs::path& from, const fs::path& to, const std::string& response, const std::string& force) {
  return measured(from, "coupled_receptance", to, "contacts.measured", response, force);
}

double found(const nlohmann::json& summary, const char* key, std::size_t i = 0, std::size_t j = 0) {
  return summary["contacts"][0]["identified"][key][i][j].get<double>();
}

/// Largest difference of an entry of two runs' coupled receptances over its largest value.
double difference(const fs::path& a, const fs::path& b, const std::string& dof) {
  const auto entry = [&](const fs::path& out) {
    return dynamics::entry(io::read_response(out / "frf" / "coupled_receptance.csv"), dof, dof);
  };
  const Eigen::VectorXcd first = entry(a);
  return (entry(b) - first).cwiseAbs().maxCoeff() / first.cwiseAbs().maxCoeff();
}

TEST(Contact, ASpringIsFoundAgainFromTheAssemblyThatWasComputedWithIt) {
  const fs::path known = scratch("contact_known"), seen = scratch("contact_found");
  (void)run(wall + robot + contact("stiffness = \"2e6 N/m\"\ndamping = \"80 N s/m\"\n"), known);
  const auto summary = run(wall + robot + contact("") + held(known, seen, "P.x", "P.x"), seen);
  std::printf("K off by %.1e, C by %.1e of themselves\n", found(summary, "stiffness_n_per_m") / 2e6 - 1.0,
              found(summary, "damping_n_s_per_m") / 80.0 - 1.0);
  EXPECT_NEAR(found(summary, "stiffness_n_per_m") / 2e6, 1.0, 1e-6);
  EXPECT_NEAR(found(summary, "damping_n_s_per_m") / 80.0, 1.0, 1e-5);
  EXPECT_GT(found(summary, "stiffness_half_width_n_per_m"), 0.0);
  EXPECT_EQ(summary["contacts"][0]["model"], "identified");
  EXPECT_EQ(summary["contacts"][0]["stiffness_n_per_m"][0].get<double>(), found(summary, "stiffness_n_per_m"));
  EXPECT_LT(difference(known, seen, "Q.y"), 1e-6) << "the joint that was found is the one that was coupled";
  EXPECT_LT(summary["coupling"]["route_difference"]["max_relative"].get<double>(), 1e-9) << "by both routes";
  const std::string text = terminal_report(summary_from(summary, "summary.json"), "results");
  EXPECT_NE(text.find("contact     P-R: x 2e+06 N/m"), std::string::npos) << text;
  EXPECT_NE(text.find("found along x: 2e+06 ±"), std::string::npos) << text;
}

// With Z⁻¹ = … − H_R an error of the robot alone moves Z by Z² δH_R, its real part by as much as δH_R has in real and
// imaginary part each, and K is the weighted mean over all lines.
TEST(Contact, TheIntervalIsThatOfTheNoiseThatTheCaseGivesTheRobot) {
  const fs::path known = scratch("contact_noise_known"), seen = scratch("contact_noise_found");
  (void)run(wall + robot + contact("stiffness = \"2e6 N/m\"\ndamping = \"80 N s/m\"\n"), known);
  const auto summary =
      run(wall + robot + contact("noise = [1e-12, 1e-12, 1e-4]\n") + held(known, seen, "P.x", "P.x"), seen);
  const dynamics::ResponseModel tip = io::read_response(known / "frf" / "robot.csv");
  const Eigen::VectorXcd H = dynamics::entry(tip, "R.x", "R.x");
  double weights = 0.0;
  for (Eigen::Index line = 0; line < H.size(); ++line) {
    const double Z = std::abs(std::complex<double>(2e6, 2.0 * M_PI * tip.axis.hz(line) * 80.0));
    weights += 1.0 / std::pow(Z * Z * 1e-4 * std::abs(H(line)), 2);
  }
  EXPECT_NEAR(found(summary, "stiffness_half_width_n_per_m") * std::sqrt(weights) / 1.959964, 1.0, 1e-4);
  EXPECT_EQ(found(summary, "lines_used"), 637.0);
}

TEST(Contact, TwoDirectionsAreFoundAsAMatrixSeenFromBesideTheContact) {
  const fs::path known = scratch("contact_two_known"), seen = scratch("contact_two_found");
  const std::string two = "directions = [\"x\", \"y\"]\n";
  // a post, for a wall hardly moves along y and tells nothing of the contact there
  const std::string post =
      with(with(with(wall, "\"150 mm\"", "\"12 mm\""), "\"80 mm\"", "\"200 mm\""), "\"5 mm\"", "\"8 mm\"");
  (void)run(post + robot + contact(two + "stiffness = [\"1e5 N/m\", \"4e4 N/m\"]\nloss_factor = 0.08\n"), known);
  std::string frfs;
  for (const char* response : {"Q.x", "Q.y"})
    for (const char* force : {"P.x", "P.y"}) frfs += held(known, seen, response, force);
  const auto summary =
      run(post + robot + contact(two + "damping_model = \"structural\"\nnoise = 0.001\n") + frfs, seen);
  EXPECT_NEAR(found(summary, "stiffness_n_per_m", 0, 0) / 1e5, 1.0, 1e-5);
  EXPECT_NEAR(found(summary, "stiffness_n_per_m", 1, 1) / 4e4, 1.0, 1e-5);
  EXPECT_LT(std::abs(found(summary, "stiffness_n_per_m", 0, 1)), 1e-5 * 4e4);
  EXPECT_NEAR(found(summary, "loss_factor", 0, 0), 0.08, 1e-5);
  EXPECT_NEAR(found(summary, "loss_factor", 1, 1), 0.08, 1e-5);
  EXPECT_LT(difference(known, seen, "P.x"), 1e-5);
  EXPECT_LT(summary["coupling"]["route_difference"]["max_relative"].get<double>(), 1e-9) << "a matrix by both routes";
}

// Nothing is modelled: part, robot and assembly are files.
TEST(Contact, AJointIsFoundBetweenMeasuredComponents) {
  const fs::path known = scratch("contact_files_known"), seen = scratch("contact_files_found");
  (void)run(wall + robot + contact("stiffness = \"1e6 N/m\"\n"), known);
  const auto summary =
      run("[robot]\nmodel = \"measured\"\n" + measured(known, "robot", seen, "robot.measured", "R.x", "R.x") +
              measured(known, "part", seen, "part.measured", "P.x", "P.x") + contact("") +
              held(known, seen, "P.x", "P.x") + "[response]\nfrom = \"10 Hz\"\nto = \"1600 Hz\"\nlines = 637\n",
          seen);
  EXPECT_NEAR(found(summary, "stiffness_n_per_m") / 1e6, 1.0, 1e-5);
  EXPECT_LT(difference(known, seen, "P.x"), 1e-5);
}

// The robot of the case is stiffer than the one that held the wall: no spring makes up for it at every line.
TEST(Contact, WhatIsNoSpringIsSeenInTheResiduals) {
  const fs::path known = scratch("contact_other_known"), seen = scratch("contact_other_found");
  (void)run(wall + robot + contact("stiffness = \"2e6 N/m\"\n"), known);
  const std::string other = with(robot, "\"35 Hz\", damping_ratio = 0.05", "\"45 Hz\", damping_ratio = 0.3");
  const auto summary = run(wall + other + contact("") + held(known, seen, "P.x", "P.x"), seen);
  EXPECT_GT(summary["contacts"][0]["identified"]["chi_squared"].get<double>(), 4.0);
  EXPECT_GT(found(summary, "stiffness_half_width_n_per_m"), 1e-3 * 2e6) << "the interval knows of it";
  // The robot of the case damps more than the other did: the contact would have to give energy, and is joined without.
  EXPECT_LT(found(summary, "damping_n_s_per_m"), 0.0);
  EXPECT_TRUE(summary["contacts"][0]["identified"]["damping_raised"].get<bool>());
  EXPECT_EQ(summary["contacts"][0]["damping_n_s_per_m"][0], 0.0);
}

TEST(Contact, AJointThatLeavesNoTraceIsRefused) {
  const fs::path known = scratch("contact_rigid_known"), seen = scratch("contact_rigid_found");
  (void)run(wall + robot + contact(""), known);
  const std::string frf = held(known, seen, "P.x", "P.x");
  try {
    (void)run(wall + robot + contact("") + frf, seen);
    ADD_FAILURE() << "a rigid joint has no stiffness to find";
  } catch (const core::NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find("P-R"), std::string::npos) << error.what();
  }
}

// k_n = (6 F R E*²)^⅓, a = (3FR/4E*)^⅓, p_0 = 3F/2πa² (Johnson 1985, Eq. 4.22-4.24), of a steel ball on the aluminium
// wall.
TEST(Contact, APressedBallIsHertzsInTheRunAndItsReport) {
  const fs::path out = scratch("contact_hertz"), same = scratch("contact_hertz_spring");
  const double R = 0.01, F = 60.0, E = 1.0 / ((1.0 - 0.09) / 210e9 + (1.0 - 0.33 * 0.33) / 70e9);
  const double k = std::cbrt(6.0 * F * R * E * E), a = std::cbrt(3.0 * F * R / (4.0 * E));
  const std::string preload = "preload = [\"-60 N\", 0, \"10 N\"]\n";
  const auto summary =
      run(wall + robot + preload + contact("model = \"hertz\"\n[contacts.ball]\nradius = \"10 mm\"\n"), out);
  const nlohmann::json& joined = summary["contacts"][0];
  EXPECT_NEAR(joined["stiffness_n_per_m"][0].get<double>() / k, 1.0, 1e-12);
  EXPECT_NEAR(joined["hertz"]["contact_radius_m"].get<double>() / a, 1.0, 1e-12);
  EXPECT_NEAR(joined["hertz"]["peak_pressure_pa"].get<double>() / (1.5 * F / (M_PI * a * a)), 1.0, 1e-12);
  EXPECT_NEAR(joined["preload_n"].get<double>(), F, 1e-12);
  EXPECT_NE(terminal_report(summary_from(summary, "summary.json"), "results").find("hertz, 60 N; radius"),
            std::string::npos);
  char stiffness[64];
  std::snprintf(stiffness, sizeof stiffness, "stiffness = \"%.17g N/m\"\n", k);
  (void)run(wall + robot + contact(stiffness), same);
  EXPECT_LT(difference(same, out, "P.x"), 1e-9) << "and couples as a spring of that stiffness";
}

const std::string cut =
    "[tool]\nteeth = 4\ndiameter = \"16 mm\"\nlength = \"20 mm\"\n[cutting]\nat = \"Q\"\nradial_depth = \"1 mm\"\n"
    "feed_per_tooth = \"0.1 mm\"\nKt = \"800 MPa\"\nKr = \"240 MPa\"\nspindle_speed = \"7000 rpm\"\n"
    "[lobes]\nfrom = \"6000 rpm\"\nto = \"8000 rpm\"\ncount = 4\n";

/// The wall with a robot that presses so hard.
std::string pressed(const std::string& newtons) {
  return wall + robot + "preload = [\"-" + newtons + " N\", 0, 0]\n" + contact("") + cut;
}

/// The depth above which the contact is lost at the case's own speed, by the summary of a run with this preload.
double lost_above(const std::string& newtons, const fs::path& out) {
  const auto summary = run(pressed(newtons), out);
  const nlohmann::json& row = summary["lobes"][1]["at_case_speed"];
  EXPECT_DOUBLE_EQ(row["contact"]["preload_n"].get<double>(), std::stod(newtons));
  const nlohmann::json& lost = row["contact"]["lost_above_m"];
  const std::string report = terminal_report(summary_from(summary, "summary.json"), "r");
  EXPECT_EQ(report.find("if the contact holds; it is lost above") == std::string::npos, lost.is_null()) << report;
  if (lost.is_null()) return std::numeric_limits<double>::infinity();
  EXPECT_LE(lost.get<double>(), row["limiting_depth_m"].get<double>());
  return lost.get<double>();
}

// Of equal teeth without helix the force goes with the depth of cut, so that twice the preload holds twice the depth.
TEST(Contact, IsLostAtADepthInProportionToItsPreload) {
  const fs::path out = scratch("contact_lost");
  const double once = lost_above("0.05", out), twice = lost_above("0.1", out);
  EXPECT_TRUE(std::isfinite(twice));
  EXPECT_NEAR(twice / once, 2.0, 0.03) << "each to 1 %";
  EXPECT_TRUE(std::isinf(lost_above("100000", out)));
}

// What is linear in the cut does not know the preload: twice of it leaves the more by as much, at every speed.
TEST(Contact, OverTheSpeedsThePreloadIsWhatMoreIsLeftOfTheContact) {
  const fs::path out = scratch("contact_over_speed");
  const auto least_at = [&](const std::string& newtons) {
    const RunResult found = run_case(parse_case(pressed(newtons), out), {out, true, -1, false, {{7000.0, 0.02e-3}}});
    const nlohmann::json summary = summary_json(found.summary);
    const nlohmann::json& curve = summary["lobes"][1]["forced_over_speed"][0];
    const fs::path file = out / "lobes" / "supported_forced.csv";
    const io::Table table = io::read_csv(file);
    const auto speeds = column(file, "spindle_speed_rpm");
    const auto least = io::numbers_or_gaps(table, "least_contact_force_n", file);
    EXPECT_DOUBLE_EQ(curve["preload_n"].get<double>(), std::stod(newtons));
    EXPECT_EQ(curve["speeds_contact_lost"], std::ranges::count_if(least, [](double n) { return n < 0.0; }));
    const auto own = static_cast<std::size_t>(std::ranges::find(speeds, 7000.0) - speeds.begin());
    EXPECT_NEAR(least.at(own), summary["operating_points"][1]["contact"]["least_force_n"].get<double>(), 1e-3);
    EXPECT_FALSE(summary["lobes"][0]["forced_over_speed"][0].contains("preload_n")) << "alone it touches nothing";
    return least;
  };
  const auto once = least_at("50"), twice = least_at("100");
  ASSERT_EQ(once.size(), twice.size());
  EXPECT_GT(std::ranges::count_if(once, [](double n) { return std::isfinite(n); }), 2);
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(std::isnan(once[i]), std::isnan(twice[i]));
    if (std::isfinite(once[i])) {
      EXPECT_NEAR(twice[i] - once[i], 50.0, 1e-9);
    }
  }
}

// The same rigid contact twice: the kernel has rank one of two. Left out is what the second repeats.
TEST(Contact, ATruncatedKernelJoinsOnceWhatIsGivenTwice) {
  const fs::path once = scratch("contact_once"), twice = scratch("contact_twice");
  (void)run(wall + robot + contact(""), once);
  const std::string doubled = wall + robot + contact("") + contact("");
  EXPECT_THROW((void)run(doubled, twice), core::NumericalError);
  const auto summary = run(doubled + "[coupling]\nregularisation = \"truncated\"\n", twice);
  EXPECT_LT(difference(once, twice, "P.x"), 1e-9);
  const nlohmann::json& coupling = summary["coupling"];
  EXPECT_EQ(coupling["regularisation"]["lines_with_dropped"], 637);
  EXPECT_EQ(coupling["regularisation"]["most_dropped"], 1);
  EXPECT_LT(coupling["regularisation"]["compatibility_residual_max"].get<double>(), 1e-9) << "both ask for the same";
  EXPECT_TRUE(coupling["route_difference"].is_null()) << "there is no spatial route, and none is claimed";
  EXPECT_NE(coupling["no_spatial_route"].get<std::string>().find("depend"), std::string::npos);
  EXPECT_NE(terminal_report(summary_from(summary, "summary.json"), "r").find("637 of 637 lines"), std::string::npos);
}

// One rigid direction has one singular value: Tikhonov leaves t²/(1 + t²) of its opening, and the routes differ.
TEST(Contact, WhatTikhonovChangesIsReportedAndNotHidden) {
  const fs::path out = scratch("contact_tikhonov");
  const auto summary =
      run(wall + robot + contact("") + "[coupling]\nregularisation = \"tikhonov\"\nthreshold = 0.1\n", out);
  const nlohmann::json& coupling = summary["coupling"];
  EXPECT_NEAR(coupling["regularisation"]["compatibility_residual_max"].get<double>(), 0.01 / 1.01, 1e-9);
  EXPECT_EQ(coupling["regularisation"]["lines_with_dropped"], 0);
  EXPECT_GT(coupling["route_difference"]["max_relative"].get<double>(), 1e-3);
  EXPECT_NE(terminal_report(summary_from(summary, "summary.json"), "r").find("coupling differ by"), std::string::npos);
}

}  // namespace
}  // namespace thinwall::tests::contact_test

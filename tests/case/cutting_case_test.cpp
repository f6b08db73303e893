// Tools, engagements and force laws of a case: what they become, and what is refused.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "case/problem.hpp"
#include "case/reader.hpp"
#include "case/writer.hpp"
#include "milling/cut/chip_load.hpp"
#include "setup/milling_process.hpp"
#include "tests/case/case_text.hpp"

namespace thinwall::tests::cutting_case_test {

using namespace setup;
using namespace cases;

namespace {

constexpr double degree = std::numbers::pi / 180.0;

/// The plate case with lines added to [tool] and [cutting].
std::string cut_case(const std::string& tool, const std::string& cutting) {
  return with(with(plate_case(), "length = \"20 mm\"\n", "length = \"20 mm\"\n" + tool), "radial_depth = \"0.2 mm\"\n",
              cutting);
}

milling::MillingProcess process_of(const std::string& text) {
  const Case c = parse_case(text, ".");
  milling::MillingProcess process = milling_process(c);
  EXPECT_TRUE(milling::validate(process).empty());
  return process;
}

void expect_problem(const std::string& text, const std::string& part) {
  try {
    (void)parse_case(text, ".");
    ADD_FAILURE() << "accepted, though " << part;
  } catch (const CaseError& error) {
    ASSERT_EQ(error.problems.size(), 1U) << error.what();
    EXPECT_NE(error.problems[0].text.find(part), std::string::npos) << error.problems[0].text;
    EXPECT_GT(error.problems[0].line, 0);
  }
}

const std::string depth = "radial_depth = \"0.2 mm\"\n";
const std::string arcs_of_two_walls =
    "entry_angle = [\"0 deg\", \"140 deg\"]\nexit_angle = [\"40 deg\", \"180 deg\"]\n";

TEST(CuttingCase, ArcsByAngles) {
  const auto process = process_of(cut_case("", arcs_of_two_walls));
  const auto arcs = milling::arcs(process);
  ASSERT_EQ(arcs.size(), 2U);
  EXPECT_NEAR(arcs[1].entry_rad, 140.0 * degree, 1e-14);
  EXPECT_NEAR(arcs[1].exit_rad, 180.0 * degree, 1e-14);
}

TEST(CuttingCase, EndsOfTheTool) {
  EXPECT_TRUE(process_of(plate_case()).cutter.envelope.straight());
  EXPECT_EQ(process_of(cut_case("end = \"ball\"\n", arcs_of_two_walls)).cutter.envelope.corner_radius_m, 0.008);
  const auto bull = process_of(cut_case("end = \"bull_nose\"\ncorner_radius = \"2 mm\"\n", arcs_of_two_walls)).cutter;
  EXPECT_DOUBLE_EQ(bull.envelope.corner_radial_m, 0.006);
  EXPECT_DOUBLE_EQ(bull.envelope.height_m, 0.020);
  const std::string taper = "end = \"general\"\ntaper = \"5 deg\"\n";
  EXPECT_NEAR(process_of(cut_case(taper, "radial_depth = \"16 mm\"\n")).cutter.envelope.taper_rad, 5.0 * degree, 1e-14);
}

TEST(CuttingCase, LawsAreLinearisedAtTheMeanChip) {
  const std::string power = depth + "law = \"power\"\nexponents = 0.25\nfeed_per_tooth = \"0.05 mm\"\n";
  const auto process = process_of(cut_case("", power));
  const double chip = milling::chip_loads(process.cutter, milling::arcs(process), 0.05e-3).front().mean_thickness_m;
  EXPECT_NEAR(process.coefficients.K_t, 0.75 * 1.8e9 * std::pow(chip / 1e-3, -0.25), 1.0);
  // 1800 mm/min at 1900 rpm over six teeth.
  const Case c = parse_case(plate_case(), ".");
  EXPECT_NEAR(feed_per_tooth(c).value_or(0.0), 1.8 / 1900.0 / 6.0, 1e-15);
  const std::string fractional = depth + "law = \"fractional\"\nchip_scale = \"18 um\"\nstiffness_ratio = 0.1\n";
  const double x =
      milling::chip_loads(process.cutter, milling::arcs(process), 1.8 / 1900.0 / 6.0).front().mean_thickness_m / 18e-6;
  EXPECT_NEAR(process_of(cut_case("", fractional)).coefficients.K_t,
              1.8e9 * (1.0 + 0.2 * x + 0.1 * x * x) / ((1.0 + x) * (1.0 + x)), 1.0);
}

TEST(CuttingCase, ObliqueCoefficientsFollowFromTheHelix) {
  const std::string oblique =
      depth + "law = \"oblique\"\nshear_stress = \"600 MPa\"\nfriction_angle = \"25 deg\"\nrake_angle = \"8 deg\"\n";
  const std::string text = with(cut_case("helices = \"30 deg\"\n", oblique), "Kt = \"1800 N/mm^2\"\n", "");
  const auto process = process_of(text);
  EXPECT_GT(process.coefficients.K_t, 600e6);
  EXPECT_LT(process.coefficients.K_a, 0.0) << "a right-hand helix draws the tool out";
}

TEST(CuttingCase, RunoutGivesTeethChipsOfTheirOwn) {
  const std::string six = "runout = [\"1 um\", \"0 um\", \"0 um\", \"0 um\", \"0 um\", \"0 um\"]\n";
  const auto linear = process_of(cut_case(six, depth + "feed_per_tooth = \"0.1 mm\"\n"));
  EXPECT_TRUE(milling::equal_teeth(linear)) << "a linear law does not feel it";
  const auto power =
      process_of(cut_case(six, depth + "feed_per_tooth = \"0.1 mm\"\nlaw = \"power\"\nexponents = [0.2, 0.3, 0.0]\n"));
  ASSERT_EQ(power.tooth_coefficients.size(), 6U);
  EXPECT_LT(power.tooth_coefficients[0].K_t, power.tooth_coefficients[1].K_t) << "a thicker chip is softer";
}

TEST(CuttingCase, LeadAndProcessDampingArrive) {
  const auto process = process_of(cut_case("", depth + "lead_angle = \"10 deg\"\nprocess_damping = \"2e4 N/m\"\n"));
  EXPECT_NEAR(process.frame.axis.y(), std::sin(10.0 * degree), 1e-14);
  EXPECT_EQ(process.damping.C, 2e4);
  EXPECT_EQ(process.damping.friction, 0.3);
}

TEST(CuttingCase, TheResolvedCaseSaysTheSame) {
  const Case c =
      parse_case(cut_case("end = \"ball\"\nrunout = [\"1 um\", \"0 um\", \"0 um\", \"0 um\", \"0 um\", \"0 um\"]\n",
                          arcs_of_two_walls),
                 ".");
  const std::string once = resolved_text(c);
  EXPECT_EQ(resolved_text(parse_case(once, ".")), once);
}

TEST(CuttingCase, WrongToolsAreRefused) {
  expect_problem(cut_case("end = \"bull_nose\"\n", arcs_of_two_walls), "needs tool.corner_radius");
  expect_problem(cut_case("end = \"bull_nose\"\ncorner_radius = \"9 mm\"\n", arcs_of_two_walls),
                 "more than half the tool's diameter of 16 mm");
  expect_problem(cut_case("corner_radius = \"2 mm\"\n", depth), "belongs to tool.end = \"bull_nose\" or \"general\"");
  expect_problem(
      cut_case("end = \"general\"\ncorner_radius = \"2 mm\"\ncorner_radial = \"12 mm\"\n", arcs_of_two_walls),
      "the arc leaves the tip cone");
  expect_problem(cut_case("end = \"ball\"\n", depth), "give cutting.entry_angle and cutting.exit_angle");
  expect_problem(cut_case("end = \"round\"\n", depth), "is none of");
  expect_problem(cut_case("runout = \"1 um\"\n", depth), "give one a tooth");
  expect_problem(cut_case("helices = \"90 deg\"\n", depth), "end mills have 30 to 45 deg");
}

TEST(CuttingCase, WrongEngagementsAreRefused) {
  expect_problem(cut_case("", ""), "cutting.radial_depth: missing");
  expect_problem(cut_case("", depth + arcs_of_two_walls), "not both");
  expect_problem(cut_case("", "entry_angle = \"40 deg\"\n"), "0 exits for 1 entries");
  expect_problem(cut_case("", "entry_angle = \"40 deg\"\nexit_angle = \"10 deg\"\n"), "the exit must follow");
  expect_problem(cut_case("", "entry_angle = [\"0 deg\", \"30 deg\"]\nexit_angle = [\"40 deg\", \"50 deg\"]\n"),
                 "overlaps");
}

TEST(CuttingCase, WrongLawsAreRefused) {
  const std::string no_feed = with(with(plate_case(), "feed_rate = \"1800 mm/min\"\n", ""), depth, "");
  const std::string power = depth + "law = \"power\"\nexponents = 0.25\n";
  expect_problem(with(no_feed, "at = \"P\"\n", "at = \"P\"\n" + power), "depends on the feed");
  expect_problem(cut_case("", depth + "law = \"power\"\n"), "cutting.exponents: missing");
  expect_problem(cut_case("", depth + "law = \"power\"\nexponents = [0.2, 0.3]\n"), "needs one exponent, or three");
  expect_problem(cut_case("", depth + "law = \"power\"\nexponents = 1.0\n"), "below 1");
  expect_problem(cut_case("", depth + "exponents = 0.2\n"), "belongs to cutting.law = \"power\"");
  expect_problem(cut_case("", depth + "law = \"fractional\"\nstiffness_ratio = 0.5\n"),
                 "cutting.chip_scale: missing; cutting.law = \"fractional\" needs it");
  expect_problem(with(plate_case(), "Kt = \"1800 N/mm^2\"\n", ""), "cutting.Kt: missing");
  expect_problem(
      cut_case("", depth + "law = \"oblique\"\nshear_stress = \"600 MPa\"\nfriction_angle = \"25 deg\"\n"),
      "cutting.Kt: belongs to cutting.law = \"linear\" or \"power\" or \"fractional\", but it is \"oblique\"");
  expect_problem(cut_case("end = \"ball\"\n", arcs_of_two_walls + "law = \"power\"\nexponents = 0.25\n"),
                 "only the linear law");
  expect_problem(cut_case("end = \"ball\"\n", arcs_of_two_walls + "process_damping = \"1e4 N/m\"\n"), "flat ends only");
}

}  // namespace
}  // namespace thinwall::tests::cutting_case_test

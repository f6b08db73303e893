// Contacts in a case: where their stiffness comes from, and what is refused.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

#include "case/numbers.hpp"
#include "case/problem.hpp"
#include "case/reader.hpp"
#include "case/writer.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "coupling/hertz_contact.hpp"
#include "setup/contact_model.hpp"
#include "setup/measured.hpp"
#include "setup/path.hpp"
#include "study/support/contact_identification.hpp"
#include "study/support/support_stage.hpp"
#include "tests/case/case_text.hpp"
#include "tests/core/temporary_folder.hpp"

namespace thinwall::tests::contact_case_test {

using namespace setup;
using namespace cases;
using namespace study;

namespace {

/// The plate's contact with more lines.
std::string with_contact(const std::string& lines) {
  return with(plate_case(), "[[contacts]]\npart = \"P\"\n", "[[contacts]]\npart = \"P\"\n" + lines);
}

std::string pressed(const std::string& text, const std::string& preload) {
  return with(text, "stiffness = \"1.7e6 N/m\"\n", "stiffness = \"1.7e6 N/m\"\npreload = " + preload + "\n");
}

const std::string ball = "[contacts.ball]\nradius = \"12.7 mm\"\n";
const std::string support = "supports = 60\nsupport_radius = \"1.5 mm\"\nsupport_angle = \"30 deg\"\n";

void expect_problem(const std::string& text, const std::string& key, const std::string& part,
                    const std::filesystem::path& folder = ".") {
  ASSERT_FALSE(text.empty()) << "the replacement did not match: " << part;
  try {
    (void)parse_case(text, folder);
    ADD_FAILURE() << "accepted, though " << part;
  } catch (const CaseError& error) {
    EXPECT_EQ(error.problems.size(), 1U) << error.what();
    const std::string& found = error.problems.front().text;
    EXPECT_EQ(found.find(key + ":"), 0U) << found;
    EXPECT_NE(found.find(part), std::string::npos) << found;
    EXPECT_EQ(found.find('\n'), std::string::npos) << found;
  }
}

/// The first contact as it is joined.
JoinedContact first_joined(const Case& source) {
  return joined_contacts(source, source).front();
}

/// k_n = (6 F R E*²)^⅓ of a steel ball of 12.7 mm on the plate's steel (Johnson 1985, Eq. 4.22-4.24).
double normal_stiffness(double force) {
  const double E = 1.0 / (2.0 * (1.0 - 0.3 * 0.3) / 210e9);
  return std::cbrt(6.0 * force * 0.0127 * E * E);
}

TEST(ContactCase, ABallIsHertzsAlongItsNormalAndMindlinsAcross) {
  const Case source = parse_case(
      with(with_contact("model = \"hertz\"\npreload = \"80 N\"\ndamping = \"3 N s/m\"\n"
                        "loss_factor = 0.02\ndirections = [\"x\", \"y\"]\n" +
                        ball),
           "frequency = \"29 Hz\"\nstiffness = \"1.7e6 N/m\"\ndamping_ratio = 0.02\n",
           "model = \"modes\"\n"
           "modes = [{ frequency = \"29 Hz\", damping_ratio = 0.02, stiffness = \"1.7e6 N/m\", direction = \"x\" },"
           " { frequency = \"30 Hz\", damping_ratio = 0.02, stiffness = \"1.7e6 N/m\", direction = \"y\" }]\n"),
      ".");
  const JoinedContact joined = joined_contacts(source, source).front();
  ASSERT_EQ(joined.contact.springs.size(), 2U);
  EXPECT_NEAR(joined.contact.springs[0].stiffness / normal_stiffness(80.0), 1.0, 1e-14);
  // k_t / k_n = 2(1 − ν)/(2 − ν) of equal materials (Johnson 1985, Eq. 7.44)
  EXPECT_NEAR(joined.contact.springs[1].stiffness / joined.contact.springs[0].stiffness, 1.4 / 1.7, 1e-14);
  for (const coupling::ContactSpring& spring : joined.contact.springs) {
    EXPECT_EQ(spring.damping, 3.0);
    EXPECT_EQ(spring.loss_factor, 0.02);
  }
  ASSERT_TRUE(joined.hertz.has_value());
  // F = ⅔ π a² p_0
  EXPECT_NEAR(2.0 / 3.0 * M_PI * std::pow(joined.hertz->contact_radius, 2) * joined.hertz->peak_pressure, 80.0, 1e-10);
}

TEST(ContactCase, TheRobotsPreloadPressesByItsShareAlongTheNormalOnEitherSide) {
  const std::string text = with_contact("model = \"hertz\"\n" + ball);
  for (const char* preload : {"[\"40 N\", \"70 N\", 0]", "[\"-40 N\", 0, \"5 N\"]"}) {
    const Case source = parse_case(pressed(text, preload), ".");
    EXPECT_NEAR(first_joined(source).contact.springs[0].stiffness / normal_stiffness(40.0), 1.0, 1e-14) << preload;
  }
  const Case both =
      parse_case(pressed(with_contact("model = \"hertz\"\npreload = \"10 N\"\n" + ball), "[40, 0, 0]"), ".");
  EXPECT_EQ(*preload_of(both, both.contacts[0]), 10.0) << "the contact's own goes first";
  expect_problem(text, "contacts[0].preload", "robot.preload has none along the first direction");
  expect_problem(pressed(text, "[0, \"70 N\", 0]"), "contacts[0].preload", "has none along the first direction");
  expect_problem(pressed(text, "[40, 0, 0]") + "[[contacts]]\npart = \"P2\"\n", "contacts[0].preload",
                 "that of all contacts together");
}

TEST(ContactCase, FitsAndPathsMoveAStiffnessThatComesFromThePreload) {
  Case source = parse_case(with_contact("model = \"hertz\"\npreload = \"10 N\"\n" + ball), ".");
  const double before = first_joined(source).contact.springs[0].stiffness;
  set_value(source, "contacts[0].preload", 80.0);
  EXPECT_NEAR(first_joined(source).contact.springs[0].stiffness / before, 2.0, 1e-14)
      << "as the cube root of the force";
  set_value(source, "contacts[0].ball.radius", 8.0 * 0.0127);
  EXPECT_NEAR(first_joined(source).contact.springs[0].stiffness / before, 4.0, 1e-14);
  source.path = Path{{{0.006, 0.1, 0.095}, {0.006, 0.2, 0.095}}, true};
  const setup::PathStation there = station(source, 1);
  EXPECT_EQ(joined_contacts(part_at(source, there), support_at(source, there))[0].contact.springs[0].stiffness,
            first_joined(source).contact.springs[0].stiffness);
}

TEST(ContactCase, WhatTheBallTouchesMayBeAnotherThanThePart) {
  const Case on_part = parse_case(with_contact("model = \"hertz\"\npreload = \"80 N\"\n" + ball), ".");
  const Case on_pad =
      parse_case(with_contact("model = \"hertz\"\npreload = \"80 N\"\n" + ball +
                              "[contacts.surface]\nyoungs_modulus = \"70 GPa\"\npoisson_ratio = 0.33\n"),
                 ".");
  const double E = 1.0 / ((1.0 - 0.09) / 210e9 + (1.0 - 0.33 * 0.33) / 70e9);
  EXPECT_NEAR(first_joined(on_pad).contact.springs[0].stiffness / std::cbrt(6.0 * 80.0 * 0.0127 * E * E), 1.0, 1e-14);
  EXPECT_LT(first_joined(on_pad).contact.springs[0].stiffness, first_joined(on_part).contact.springs[0].stiffness);
}

// All parts of a caster in series: the ball on the part, and 60 balls at 30 degrees between ball and cup (Eq. 20).
TEST(ContactCase, ACasterIsSofterThanItsBallByTheBallsThatCarryIt) {
  const Case source = parse_case(with_contact("model = \"caster\"\npreload = \"80 N\"\n" + ball + support), ".");
  const double E = 0.5 * 210e9 / (1.0 - 0.09), cosine = std::sqrt(3.0) / 2.0, Q = 80.0 / (60.0 * cosine);
  const auto k = [&](double force, double curvature) { return std::cbrt(6.0 * force * E * E / curvature); };
  const double ball_to_ball = k(Q, 1.0 / 0.0127 + 1.0 / 0.0015), ball_to_cup = k(Q, 1.0 / 0.0015 - 1.0 / 0.0157);
  const double carrying = 60.0 * cosine * cosine / (1.0 / ball_to_ball + 1.0 / ball_to_cup);
  const double expected = 1.0 / (1.0 / normal_stiffness(80.0) + 1.0 / carrying);
  EXPECT_NEAR(first_joined(source).contact.springs[0].stiffness / expected, 1.0, 1e-12);
}

TEST(ContactCase, ATableGivesItsRowsAndNothingBeyondThem) {
  const TemporaryFolder folder;
  core::write_file_atomically(folder.path / "pad.csv",
                              "# pad on aluminium\npreload_n,stiffness_n_per_m,damping_n_s_per_m\n10,1e6,20\n"
                              "40,3e6,35\n80,4e6,30\n");
  const std::string text =
      with_contact("model = \"table\"\npreload = \"40 N\"\ntable = \"pad.csv\"\nloss_factor = 0.1\n");
  const Case source = parse_case(text, folder.path);
  const coupling::ContactSpring spring = first_joined(source).contact.springs.at(0);
  EXPECT_DOUBLE_EQ(spring.stiffness, 3e6);
  EXPECT_DOUBLE_EQ(spring.damping, 35.0);
  EXPECT_EQ(spring.loss_factor, 0.1);
  EXPECT_EQ(input_files(source).front(), folder.path / "pad.csv");
  const double between = first_joined(parse_case(with(text, "40 N", "60 N"), folder.path)).contact.springs[0].stiffness;
  EXPECT_GT(between, 3e6);
  EXPECT_LT(between, 4e6);
  expect_problem(with(text, "40 N", "90 N"), "contacts[0].table", "measured from 10 to 80 N", folder.path);
  expect_problem(with(text, "pad.csv", "pat.csv"), "contacts[0].table", "there is no file", folder.path);
  expect_problem(with(text, "table = \"pad.csv\"\n", ""), "contacts[0].table",
                 "missing; contacts[0].model = \"table\" needs it", folder.path);
  core::write_file_atomically(folder.path / "bad.csv",
                              "preload_n,stiffness_n_per_mm,damping_n_s_per_m\n1,1,0\n2,2,0\n");
  expect_problem(with(text, "pad.csv", "bad.csv"), "contacts[0].table", "did you mean \"stiffness_n_per_mm\"",
                 folder.path);
  core::write_file_atomically(folder.path / "back.csv",
                              "preload_n,stiffness_n_per_m,damping_n_s_per_m\n9,1,0\n2,2,0\n");
  EXPECT_THROW((void)read_contact_table(folder.path / "back.csv"), core::DataError);
}

TEST(ContactCase, KeysOfAnotherModelAndWhatIsMissingAreSaid) {
  expect_problem(with_contact("preload = \"10 N\"\n"), "contacts[0].preload", "but it is \"springs\"");
  expect_problem(with_contact(ball), "contacts[0].ball", "belongs to contacts[0].model = \"hertz\" or \"caster\"");
  expect_problem(with_contact("model = \"hertz\"\npreload = \"10 N\"\n"), "contacts[0].ball", "missing");
  expect_problem(with_contact("model = \"hertz\"\npreload = \"10 N\"\nstiffness = \"1e6 N/m\"\n" + ball),
                 "contacts[0].stiffness", "belongs to contacts[0].model = \"springs\"");
  expect_problem(with_contact("model = \"hertz\"\npreload = \"10 N\"\n" + ball + "supports = 5\n"),
                 "contacts[0].ball.supports", "belongs to contacts[0].model = \"caster\"");
  expect_problem(with_contact("model = \"caster\"\npreload = \"10 N\"\n" + ball +
                              "supports = 5\n"
                              "support_radius = \"1 mm\"\n"),
                 "contacts[0].ball.support_angle", "missing");
  expect_problem(with_contact("model = \"hertz\"\npreload = \"0 N\"\n" + ball), "contacts[0].preload", "above 0");
  expect_problem(with_contact("model = \"hertz\"\npreload = \"10 mm\"\n" + ball), "contacts[0].preload", "is a length");
  expect_problem(with_contact("model = \"hertz\"\npreload = \"10 N\"\n" + with(ball, "12.7 mm", "-1 mm")),
                 "contacts[0].ball.radius", "above 0");
  expect_problem(with_contact("model = \"ball\"\n"), "contacts[0].model", "hertz");
  const std::string two = "directions = [\"x\", [1, 1, 0]]\n";
  const std::string free_robot =
      "model = \"modes\"\nmodes = [{ frequency = \"29 Hz\", damping_ratio = 0.02, stiffness = \"1e6 N/m\", direction "
      "= \"x\" }, { frequency = \"9 Hz\", damping_ratio = 0.02, stiffness = \"1e6 N/m\", direction = \"y\" }]\n";
  const auto in_plane = [&](const std::string& lines) {
    return with(with_contact(lines), "frequency = \"29 Hz\"\nstiffness = \"1.7e6 N/m\"\ndamping_ratio = 0.02\n",
                free_robot);
  };
  expect_problem(in_plane("model = \"hertz\"\npreload = \"10 N\"\n" + two + ball), "contacts[0].directions",
                 "right angles");
  expect_problem(in_plane("model = \"caster\"\npreload = \"10 N\"\n" + two + ball + support), "contacts[0].directions",
                 "is known along one direction");
  const auto fitted = with(with_contact("model = \"hertz\"\npreload = \"10 N\"\n" + ball), "name = \"free length\"",
                           "name = \"free length\"\non = \"coupled\"");
  expect_problem(with(with(fitted, "\"part_frequency\"", "\"coupled_frequency\""),
                      "part.length\", lower = \"380 mm\", upper = \"410 mm\"",
                      "contacts[0].stiffness\", lower = \"1e5 N/m\", upper = \"1e7 N/m\""),
                 "updating[0].parameters[0].key", "the case has no number \"contacts[0].stiffness\"");
}

TEST(ContactCase, AJointToBeFoundNeedsItsFrfsAndNothingThatTellsIt) {
  const TemporaryFolder folder;
  core::write_file_atomically(folder.path / "held.csv", "1,1e-6,0\n2,1e-6,0\n");
  const std::string frf = "file = \"held.csv\"\nquantity = \"receptance\"\nunit = \"m/N\"\n";
  const auto measured = [&](const std::string& response, const std::string& force) {
    return "[[contacts.measured]]\nresponse = \"" + response + "\"\nforce = \"" + force + "\"\n" + frf;
  };
  const Case source = parse_case(with_contact("noise = [0.02, 0.01, 0.03]\n" + measured("P2.x", "P.x")), folder.path);
  EXPECT_EQ(std::get<SpringContact>(source.contacts[0].model).noise, (std::vector<double>{0.02, 0.01, 0.03}));
  EXPECT_EQ(input_files(source).front(), folder.path / "held.csv");
  const auto refuse = [&](const std::string& lines, const std::string& key, const std::string& part) {
    expect_problem(with_contact(lines), key, part, folder.path);
  };
  refuse("stiffness = \"1e6 N/m\"\n" + measured("P.x", "P.x"), "contacts[0].measured", "remove stiffness");
  refuse("damping = \"1 N s/m\"\n" + measured("P.x", "P.x"), "contacts[0].measured", "remove stiffness");
  refuse("model = \"hertz\"\npreload = \"9 N\"\n" + ball + measured("P.x", "P.x"), "contacts[0].measured",
         "belongs to contacts[0].model = \"springs\"");
  refuse(measured("P.y", "P.y"), "contacts[0].measured", "do not tell all directions");
  refuse(measured("Q.x", "Q.x"), "contacts[0].measured[0].response", "there is no point \"Q\"");
  refuse(measured("P.x", "P.x") + measured("P2.x", "P.x"), "contacts[0].measured[1].response", "of another point");
  refuse("noise = [0.01, 0.02]\n", "contacts[0].noise", "one value, or three");
  refuse("noise = 0\n", "contacts[0].noise", "above 0");
  refuse(with(measured("P.x", "P.x"), "held.csv", "none.csv"), "contacts[0].measured[0].file", "there is no file");
  refuse(with(measured("P.x", "P.x"), "unit = \"m/N\"", "unit = \"kg\""), "contacts[0].measured[0].unit", "no unit");
  expect_problem(with_contact(measured("P.x", "P.x")) + "[[contacts]]\npart = \"P2\"\n", "contacts[0].measured",
                 "one contact", folder.path);
}

TEST(ContactCase, AnAssemblyIsReadWhereAllItsFilesReach) {
  const TemporaryFolder folder;
  core::write_file_atomically(folder.path / "low.csv", "10,1,0\n20,2,0\n30,3,0\n40,4,0\n");
  core::write_file_atomically(folder.path / "high.csv", "20,5,0\n30,6,0\n40,7,0\n50,8,0\n");
  const auto file = [&](const char* response, const char* force, const char* name) {
    MeasuredFrf frf{response, force, folder.path / name, io::FrfQuantity::receptance, "m/N", "Hz", {}};
    frf.content = std::make_shared<const FrfContent>(read_measured(frf));
    return frf;
  };
  const dynamics::FrequencyAxis axis = dynamics::linear_axis(10.0, 60.0, 6);
  const auto G = assembly_response(
      {file("P.x", "P.x", "low.csv"), file("P.y", "P.x", "high.csv"), file("P.y", "P.y", "low.csv")}, axis);
  EXPECT_EQ(G.axis.hz, Eigen::Vector3d(20.0, 30.0, 40.0));
  EXPECT_EQ(dynamics::entry(G, "P.x", "P.y")(0).real(), 5.0) << "by reciprocity";
  const auto across = assembly_response({file("Q.x", "P.x", "low.csv")}, axis);
  EXPECT_EQ(across.H.size(), 4U);
  EXPECT_EQ(across.responses.size() * across.forces.size(), 1U) << "nothing else is asked for";
  try {
    (void)assembly_response({file("P.x", "P.x", "low.csv")}, dynamics::linear_axis(50.0, 60.0, 6));
    ADD_FAILURE() << "no line in common";
  } catch (const core::InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("50 to 60 Hz"), std::string::npos) << text;
    EXPECT_NE(text.find("from 10 to 40 Hz"), std::string::npos) << text;
  }
  EXPECT_THROW((void)assembly_response({file("P.x", "P.x", "low.csv"), file("P.y", "P.y", "low.csv")}, axis),
               core::InputError);
}

TEST(ContactCase, TheResolvedCaseIsTheSame) {
  for (const std::string& text :
       {with_contact("model = \"caster\"\npreload = \"80 N\"\n" + ball + support +
                     "[contacts.surface]\nyoungs_modulus = \"70 GPa\"\npoisson_ratio = 0.33\n"),
        plate_case() + "[coupling]\nregularisation = \"truncated\"\nthreshold = 1e-8\n"}) {
    const Case first = parse_case(text, ".");
    const Case second = parse_case(resolved_text(first), ".");
    EXPECT_EQ(resolved_text(second), resolved_text(first));
    EXPECT_EQ(first_joined(second).contact.springs[0].stiffness, first_joined(first).contact.springs[0].stiffness);
    EXPECT_EQ(coupling_options(second.coupling).threshold, coupling_options(first.coupling).threshold);
    EXPECT_EQ(coupling_options(second.coupling).regularisation, coupling_options(first.coupling).regularisation);
  }
}

TEST(ContactCase, ARegularisationIsAskedForInFull) {
  EXPECT_EQ(coupling_options(parse_case(plate_case(), ".").coupling).regularisation, coupling::Regularisation::none);
  expect_problem(plate_case() + "[coupling]\nthreshold = 1e-6\n", "coupling.threshold",
                 "belongs to coupling.regularisation = \"truncated\" or \"tikhonov\"");
  expect_problem(plate_case() + "[coupling]\nregularisation = \"truncated\"\nthreshold = 1\n", "coupling.threshold",
                 "below 1");
  expect_problem(plate_case() + "[coupling]\nregularisation = \"svd\"\n", "coupling.regularisation", "truncated");
}

}  // namespace
}  // namespace thinwall::tests::contact_case_test

// Every way in which a case can be wrong: where, what, and what to do.

#include <gtest/gtest.h>

#include <filesystem>

#include "case/checks/checks.hpp"
#include "case/reader.hpp"
#include "core/atomic_file.hpp"
#include "tests/case/case_text.hpp"
#include "tests/case/problems_of.hpp"

namespace thinwall::tests::bad_case_test {

using namespace setup;
using namespace cases;

namespace {

/// The one problem of the plate case with `from` replaced by `to`.
Problem problem_of(const std::string& from, const std::string& to) {
  const auto problems = problems_of(with(plate_case(), from, to));
  EXPECT_EQ(problems.size(), 1U) << from << " -> " << to;
  for (const auto& problem : problems) {
    EXPECT_EQ(problem.text.find('\n'), std::string::npos);
    if (problems.size() > 1) ADD_FAILURE() << problem.text;
  }
  return problems.empty() ? Problem{} : problems.front();
}

void expect_problem(const std::string& from, const std::string& to, const std::string& part) {
  const Problem problem = problem_of(from, to);
  EXPECT_NE(problem.text.find(part), std::string::npos) << problem.text;
}

TEST(BadCase, TheGoodCaseHasNoProblem) {
  EXPECT_TRUE(problems_of(plate_case()).empty());
}

TEST(BadCase, EmptyMissingAndMalformedCasesAreRefused) {
  EXPECT_NE(problems_of("\n").at(0).text.find("a case holds a part"), std::string::npos);
  EXPECT_THROW((void)read_case("/nowhere/at/all"), core::InputError);
  const auto malformed = problems_of("[part]\nlength = 6 mm\n");
  ASSERT_EQ(malformed.size(), 1U);
  EXPECT_EQ(malformed[0].line, 2);
  EXPECT_NE(malformed[0].text.find("quantities with units go in quotes"), std::string::npos);
}

TEST(BadCase, AnUnknownKeyNamesTheNearestAndItsPlace) {
  const Problem problem = problem_of("thickness = \"6 mm\"", "thickness = \"6 mm\"\n  thicknes = \"6 mm\"");
  EXPECT_EQ(problem.line, 6);
  EXPECT_EQ(problem.column, 3);
  EXPECT_NE(problem.text.find("part.thicknes: unknown key (did you mean \"thickness\"?)"), std::string::npos);
  expect_problem("[part.material]", "element_size = 1\n[part.material]", "belongs to [part.mesh]");
  expect_problem("[points.P]", "[points.\"P 1\"]\nat = [1.0, 0.5, 0.5]\n[points.P]", "a name starts with a letter");
}

TEST(BadCase, AWordOfTheFieldIsAnsweredWithTheKeyThatIsMeant) {
  expect_problem("[cutting]", "[cutting]\nfz = \"0.1 mm\"",
                 "cutting.fz: unknown key (did you mean \"feed_per_tooth\"?)");
  expect_problem("[cutting]", "[cutting]\nap = \"1 mm\"",
                 "cutting.ap: unknown key (did you mean \"depth_limit\" of [lobes]?); a chart finds the depth");
  expect_problem("[part]", "[part]\nnu = 0.3",
                 "part.nu: unknown key (did you mean \"poisson_ratio\" of [part.material]?)");
  expect_problem("thickness = \"6 mm\"", "thickness = \"2 mm - 4 mm\"",
                 "is a range, but one value is expected; for many write thinwall sweep CASE "
                 "part.thickness=\"2 mm:4 mm:STEP\"");
}

TEST(BadCase, WrongTypesSayWhatIsExpected) {
  expect_problem("length = \"392 mm\"", "length = true", "got true or false, expected a length such as \"6 mm\"");
  expect_problem("element_size = \"12 mm\"", "element_size = \"12 mm\"\norder = 2.5", "expected a whole number");
  expect_problem("title = \"plate\"", "title = 3", "expected a text in quotes");
  expect_problem("at = [1.0, 0.5, 0.95]", "at = [1.0, 0.5]", "list of three");
  expect_problem("[robot]", "[robot]\npreload = \"40 N\"", "such as [\"80 N\", \"80 N\", \"80 N\"]");
  expect_problem("[damping]", "[modes]\nverify = 1\n[damping]", "expected true or false");
}

TEST(BadCase, WrongDimensionsNameBothAndAnExample) {
  const Problem problem = problem_of("youngs_modulus = \"210 GPa\"", "youngs_modulus = \"210 mm\"");
  EXPECT_EQ(
      problem.text,
      "part.material.youngs_modulus: \"210 mm\" is a length, but a stress is expected; write for example \"210 GPa\"");
  EXPECT_EQ(problem.line, 7);
  expect_problem("from = \"1000 rpm\"", "from = 1000", "write \"1000 rpm\"");
  expect_problem("lower = \"380 mm\"", "lower = \"380 Hz\"", "is a frequency, but a length is expected");
  expect_problem("value = \"212 Hz\"", "value = \"212 mm\"", "is a length, but a frequency is expected");
}

TEST(BadCase, OutOfRangeNamesTheBoundAndTheRemedy) {
  expect_problem("poisson_ratio = 0.3", "poisson_ratio = 0.5", "at least 0, below 0.5");
  expect_problem("density = \"7850 kg/m^3\"", "density = 7.85", "write the unit: \"7.85 g/cm^3\"");
  expect_problem("youngs_modulus = \"210 GPa\"", "youngs_modulus = 210", "write the unit: \"210 GPa\"");
  expect_problem("damping_ratio = 0.02", "damping_ratio = 1.0", "below 1");
  expect_problem("spindle_speed = \"1900 rpm\"", "spindle_speed = \"0 rpm\"", "above 0 rpm");
  expect_problem("from = \"1000 rpm\"", "from = \"4000 rpm\"", "must lie below the highest");
  expect_problem("radial_depth = \"0.2 mm\"", "radial_depth = \"17 mm\"", "more than the tool's diameter of 16 mm");
  expect_problem("thickness = \"6 mm\"", "thickness = \"0 mm\"", "above 0 m");
  expect_problem("teeth = 6", "teeth = 0", "at least 1");
  expect_problem("at = [1.0, 0.5, 0.95]", "at = [1.2, 0.5, 0.95]", "at most 1");
  expect_problem("offset = [\"0 mm\", \"20 mm\"", "offset = [\"0 mm\", \"200 mm\"", "lies outside the part");
  expect_problem("to = \"3000 rpm\"", "to = \"3000 rpm\"\ndepth_limit = \"30 mm\"",
                 "more than the tool's length of 20 mm");
}

TEST(BadCase, SubstructuresArePowersOfTwoAndNotVerified) {
  const auto modes = [](const std::string& lines) { return "[modes]\n" + lines + "\n[points.P]"; };
  const std::string good = with(plate_case(), "[points.P]", modes("substructures = 8"));
  EXPECT_EQ(parse_case(good, ".").modes.substructures, 8);
  EXPECT_EQ(parse_case(plate_case(), ".").modes.substructures, 0);
  expect_problem("[points.P]", modes("substructures = 6"), "6 is no power of two; take 4 or 8");
  expect_problem("[points.P]", modes("substructures = 1"), "at least 2");
  expect_problem("[points.P]", modes("substructures = 4\nverify = true"), "compares frequencies to 1e-8");
  const auto to_tolerance = [](const std::string& text) {
    return with(text, "element_size = \"12 mm\"", "tolerance = 9e-5");
  };
  EXPECT_NO_THROW((void)parse_case(to_tolerance(plate_case()), "."));
  EXPECT_THROW((void)parse_case(to_tolerance(good), "."), core::InputError);
}

TEST(BadCase, NanAndInfinityAreNeverTaken) {
  expect_problem("poisson_ratio = 0.3", "poisson_ratio = nan", "finite");
  expect_problem("length = \"392 mm\"", "length = inf", "finite");
  expect_problem("stiffness = \"1.7e6 N/m\"", "stiffness = \"inf\"", "finite");
}

TEST(BadCase, ReferencesMustExist) {
  expect_problem("on = \"y_min\"", "on = \"y_mim\"", "did you mean \"y_min\"?");
  expect_problem("[[contacts]]\npart = \"P\"", "[[contacts]]\npart = \"P3\"",
                 "there is no point \"P3\" (did you mean \"P");
  expect_problem("[[contacts]]\npart = \"P\"", "[[contacts]]\npart = \"P\"\nrobot = \"S\"", "point of the robot \"S\"");
  expect_problem("key = \"part.length\"", "key = \"part.lenght\"", "did you mean \"part.length\"?");
  expect_problem("point = \"P.x\"", "point = \"Q.x\"", "there is no point \"Q\"");
  expect_problem("at = \"P\"", "at = \"X\"", "there is no point \"X\"");
}

TEST(BadCase, PitchesAndHelicesAreOneAToothWithinTheirBounds) {
  const auto pitches = [](const std::string& list) { return "teeth = 6\npitches = " + list; };
  expect_problem("teeth = 6", pitches(R"(["60 deg", "60 deg"])"), "2 values for 6 teeth");
  expect_problem("teeth = 6", pitches(R"(["60 deg", "60 deg", "60 deg", "60 deg", "60 deg", "50 deg"])"),
                 "the pitches come to 350 deg together");
  expect_problem("teeth = 6", pitches(R"(["0 deg", "120 deg", "60 deg", "60 deg", "60 deg", "60 deg"])"), "above 0");
  expect_problem("teeth = 6", pitches(R"(["60 mm", "60 deg", "60 deg", "60 deg", "60 deg", "60 deg"])"),
                 "is a length, but a");
  expect_problem("teeth = 6", pitches("[1.0, nan, 1.0, 1.0, 1.0, 1.0]"), "finite");
  EXPECT_TRUE(problems_of(with(plate_case(), "teeth = 6",
                               pitches(R"(["55 deg", "65 deg", "55 deg", "65 deg", "55 deg", "65 deg"])")))
                  .empty());
  const auto helices = [](const std::string& value) { return "teeth = 6\nhelices = " + value; };
  expect_problem("teeth = 6", helices(R"("90 deg")"), "tool.helices");
  expect_problem("teeth = 6", helices(R"("-30 deg")"), "at least 0");
  expect_problem("teeth = 6", helices(R"(["30 deg", "35 deg"])"), "2 values for 6 teeth");
  EXPECT_TRUE(problems_of(with(plate_case(), "teeth = 6", helices(R"("30 deg")"))).empty());
}

TEST(BadCase, AMeasuredToolStandsForItselfAndTakesStraightEqualTeeth) {
  const std::string tip =
      "[[tool.measured]]\nresponse = \"x\"\nforce = \"x\"\nfile = \"nowhere.csv\"\nquantity = \"receptance\"\n"
      "unit = \"m/N\"\n[cutting]";
  expect_problem("[cutting]", tip, "there is no file");
  expect_problem("at = \"P\"\n", "", "cutting.at: missing");
}

TEST(BadCase, AContactOnAClampedFaceIsRefused) {
  const auto problems = problems_of(with(plate_case(), "at = [1.0, 0.5, 0.95]", "at = [1.0, 0.0, 0.95]"));
  ASSERT_EQ(problems.size(), 2U);
  EXPECT_NE(problems[0].text.find("contacts[0].part: point \"P\" is clamped by \"y_min\""), std::string::npos);
  EXPECT_NE(problems[1].text.find("cutting.at"), std::string::npos);
}

TEST(BadCase, AContactAcrossTheHeldDirectionIsAllowed) {
  auto text = with(plate_case(), "at = [1.0, 0.5, 0.95]", "at = [1.0, 0.0, 0.95]");
  text = with(text, "on = \"y_min\"", "on = \"y_min\"\nfixed = [\"y\"]");
  text = with(text, "[cutting]\nat = \"P\"", "[cutting]\nat = \"P2\"");
  EXPECT_TRUE(problems_of(text).empty());
}

TEST(BadCase, AMeshBeyondMemoryIsRefusedWithItsEstimate) {
  // 392 · 100 · 6 mm³ · 6√2 / (0.3 mm)³ = 7.4e7 tetrahedra; (0.27 mm)³ makes 1e8.
  expect_problem("element_size = \"12 mm\"", "element_size = \"0.27 mm\"", "would make about 1.014e+08 tetrahedra");
  EXPECT_EQ(problem_of("element_size = \"12 mm\"", "element_size = \"0.3 mm\"").line, 11);
}

TEST(BadCase, MoreDegreesOfFreedomThanAreSolvedAreRefusedWithOrderAndSize) {
  // 392 · 100 · 6 mm³ · 6√2 / (1 mm)³ = 1.996e6 tetrahedra of order 2, 5.7 DOFs each.
  expect_problem("element_size = \"12 mm\"", "element_size = \"1 mm\"",
                 "1 mm of order 2 would make about 1.138e+07 degrees of freedom, at most 5e+06 are solved");
  expect_problem("element_size = \"12 mm\"", "element_size = \"1 mm\"", "or a lower part.mesh.order");
}

TEST(BadCase, AGradingWithoutASizeAtThePointsIsRefused) {
  expect_problem("element_size = \"12 mm\"", "element_size = \"12 mm\"\ngrading = 1.2", "nothing to grade");
  EXPECT_TRUE(problems_of(with(plate_case(), "element_size = \"12 mm\"",
                               "element_size = \"12 mm\"\ngrading = 1.2\npoint_element_size = \"0.2 mm\""))
                  .empty());
  // Without growth the size at the points is that of the whole part.
  expect_problem("element_size = \"12 mm\"", "element_size = \"12 mm\"\ngrading = 1.0\npoint_element_size = \"0.2 mm\"",
                 "larger elements at the points");
}

std::string coupled_fit(const std::string& key, const std::string& bounds, const std::string& target) {
  return with(plate_case(), "[tool]",
              "[[updating]]\nname = \"coupled\"\non = \"coupled\"\nparameters = [{ key = \"" + key + "\", " + bounds +
                  " }]\ntargets = [{ " + target + " }]\n[tool]");
}

const std::string stiffness_bounds = "lower = \"1e6 N/m\", upper = \"1e7 N/m\"";
const std::string main_mode = "quantity = \"coupled_frequency\", value = \"38 Hz\", point = \"P.x\"";

void expect_only(const std::string& text, const std::string& part) {
  const auto problems = problems_of(text);
  ASSERT_EQ(problems.size(), 1U) << part;
  EXPECT_NE(problems[0].text.find(part), std::string::npos) << problems[0].text;
  EXPECT_GT(problems[0].line, 0) << problems[0].text;
  EXPECT_GT(problems[0].column, 0) << problems[0].text;
}

TEST(BadCase, AFitWhoseParametersOrTargetsBelongToTheOtherModelIsRefused) {
  const std::string good = coupled_fit("robot.stiffness", stiffness_bounds, main_mode);
  EXPECT_TRUE(problems_of(good).empty());
  expect_only(coupled_fit("part.length", "lower = \"380 mm\", upper = \"410 mm\"", main_mode),
              "updating[1].parameters[0].key: part.length does not change the reduced part");
  expect_problem("key = \"part.length\", lower = \"380 mm\", upper = \"410 mm\"",
                 "key = \"robot.stiffness\", " + stiffness_bounds, "does not move the modes of the part");
  expect_only(with(good, "coupled_frequency", "part_frequency"), "a result of the part alone; set on = \"part\"");
  expect_problem("\"part_frequency\"", "\"coupled_frequency\"", "a result of the coupled model");
  expect_only(coupled_fit("robot.stiffness", stiffness_bounds, main_mode + ", match = \"mac\""),
              "take participation or number");
  expect_only(with(good, "value = \"38 Hz\", point = \"P.x\"", "value = \"38 Hz\", point = \"P\""),
              "names no direction");
}

TEST(BadCase, AFitWithoutItsModelIsRefused) {
  const std::string good = coupled_fit("robot.stiffness", stiffness_bounds, main_mode);
  expect_only(with(good, "[[contacts]]\npart = \"P\"\n", ""), "needs [robot], [[contacts]] and [points]");
  auto loose = with(good, "[[part.supports]]\non = \"y_min\"\n", "");
  loose = with(loose, "[[part.supports]]\non = \"y_max\"\nfixed = [\"x\", \"y\", \"z\"]\n", "");
  const auto problems = problems_of(loose);
  ASSERT_EQ(problems.size(), 2U);
  EXPECT_NE(problems[0].text.find("updating[1].on: \"coupled\" needs a part that is held"), std::string::npos);
  EXPECT_NE(problems[1].text.find("lobes: lobes need a part that is held and modelled; add [[part.supports]]"),
            std::string::npos);
}

TEST(BadCase, AContactJoinsOnlyWhatBothSidesKnow) {
  expect_problem("[[contacts]]\npart = \"P\"", "[[contacts]]\npart = \"P\"\ndirections = [\"x\", \"y\"]",
                 "the robot resists along robot.direction only");
  expect_problem("stiffness = \"1.7e6 N/m\"", "stiffness = \"1.7e6 N/m\"\ndirection = \"y\"",
                 "the robot resists along robot.direction only");
  auto text = with(plate_case(), "[points.P2]\n", "[points.P2]\ndirections = [\"y\", \"z\"]\n");
  EXPECT_TRUE(problems_of(text).empty());
  expect_only(with(text, "[[contacts]]\npart = \"P\"", "[[contacts]]\npart = \"P2\""),
              "point \"P2\" is not known in all of these directions");
  expect_only(with(text, "[cutting]\nat = \"P\"", "[cutting]\nat = \"P2\""), "in x, y and z; leave out points.P2");
  text = with(text, "stiffness = \"1.7e6 N/m\"", "stiffness = \"1.7e6 N/m\"\ndirection = [0, 3, 4]");
  text = with(text, "[[contacts]]\npart = \"P\"", "[[contacts]]\npart = \"P2\"\ndirections = [[0, 3, 4]]");
  EXPECT_TRUE(problems_of(text).empty());
}

TEST(BadCase, PointsThatTheReductionLeavesOutCannotBeAskedFor) {
  const auto kept = with(plate_case(), "[damping]", "[reduction]\ninterface = [\"P\"]\n[damping]");
  EXPECT_TRUE(problems_of(kept).empty());
  const std::string remedy = "point \"P2\" is not kept by the reduction; add it to reduction.interface";
  expect_only(with(kept, "[[contacts]]\npart = \"P\"", "[[contacts]]\npart = \"P2\""), remedy);
  expect_only(with(kept, "[cutting]\nat = \"P\"", "[cutting]\nat = \"P2\""), remedy);
  expect_only(with(kept, "[tool]", "[response]\npoints = [\"P2\"]\n[tool]"), remedy);
  const auto fit = coupled_fit("robot.stiffness", stiffness_bounds,
                               "quantity = \"coupled_frequency\", value = \"38 Hz\", point = \"P2.x\"");
  expect_only(with(fit, "[damping]", "[reduction]\ninterface = [\"P\"]\n[damping]"), remedy);
}

std::string frf(const std::string& response, const std::string& force) {
  return "response = \"" + response + "\"\nforce = \"" + force +
         "\"\nfile = \"part_xx.csv\"\nquantity = \"receptance\"\nunit = \"m/N\"\n";
}

/// Problems of a case beside the files of barrios-2019-measured.
void expect_only_measured(const std::string& text, const std::string& part) {
  std::vector<Problem> problems;
  try {
    (void)parse_case(text, std::filesystem::path(THINWALL_SOURCE_DIR) / "cases" / "barrios-2019-measured");
  } catch (const CaseError& error) {
    problems = error.problems;
  }
  ASSERT_EQ(problems.size(), part.empty() ? 0U : 1U) << (problems.empty() ? part : problems.back().text);
  if (part.empty()) return;
  EXPECT_NE(problems[0].text.find(part), std::string::npos) << problems[0].text;
  EXPECT_GT(problems[0].line, 0) << problems[0].text;
}

TEST(BadCase, AMeasuredRobotIsOneDrivingPointAlongItsDirection) {
  const std::string robot = "[[part.measured]]\n" + frf("P.x", "P.x") + "[robot]\nmodel = \"measured\"\n";
  const std::string measured = "[[robot.measured]]\n";
  const std::string contact = "[[contacts]]\npart = \"P\"\n";
  expect_only_measured(robot + measured + frf("R.x", "R.x") + contact, "");
  expect_only_measured(robot + measured + frf("R.y", "R.y") + contact, "is not along robot.direction; give \"R.x\"");
  expect_only_measured(robot + measured + frf("R.x", "R.y") + contact, "a single file is a driving point");
  expect_only_measured(robot + measured + frf("R.x", "R.x") + measured + frf("R.x", "R.x") + contact,
                       "robot.measured[1].response: the response of R.x to a force at R.x is there twice");
  expect_only_measured(
      robot + "direction = \"y\"\n" + measured + frf("R.y", "R.y") + contact + "directions = [\"y\"]\n",
      "point \"P\" is not known in all of these directions");
  const std::string slanted = robot + "direction = [3, 4, 0]\n" + measured + frf("R.y", "R.y");
  expect_only_measured(slanted, "");
}

TEST(BadCase, AFitOrAChartOfAMeasuredPartIsRefused) {
  const std::string part = "[[part.measured]]\n" + frf("P.x", "P.x");
  const std::string tool = "[tool]\nteeth = 2\ndiameter = \"16 mm\"\nlength = \"20 mm\"\n";
  const std::string modes =
      "[[tool.modes]]\nfrequency = \"500 Hz\"\ndamping_ratio = 0.02\nstiffness = \"1e7 N/m\"\ndirection = \"x\"\n";
  const std::string cut = "[cutting]\nat = \"P\"\nradial_depth = \"1 mm\"\nKt = \"600 N/mm^2\"\n";
  const std::string lobes = "[lobes]\nfrom = \"1000 rpm\"\nto = \"2000 rpm\"\n";
  expect_only_measured(part + tool + cut + lobes, "lobes: lobes need a part that is held and modelled; describe it");
  expect_only_measured(tool + modes + cut + lobes, "");
  expect_only_measured(part + "[damping]\nratio = 0.01\n[[updating]]\nname = \"length\"\n" +
                           "parameters = [{ key = \"response.to\", lower = \"1 Hz\", upper = \"2 kHz\" }]\n" +
                           "targets = [{ quantity = \"part_frequency\", value = \"212 Hz\", point = \"P.x\" }]\n",
                       "updating[0]: there is no modelled part to fit");
}

TEST(BadCase, DampingComesFromOneSourceAndFromADrivingPoint) {
  const auto text = [](const std::string& response, const std::string& force) {
    auto from_frf = with(plate_case(), "[robot]", "[damping.from_frf]\n" + frf(response, force) + "[robot]");
    return with(from_frf, "ratios = [0.008, \"0.6 %\"]\n", "");
  };
  expect_only_measured(text("P.x", "P.x"), "");
  expect_only_measured(text("P.x", "P2.x"), "damping.from_frf.force: \"P2.x\" is not the DOF that moves");
  expect_only_measured(text("Q.x", "Q.x"), "there is no point \"Q\"");
  expect_only_measured(with(plate_case(), "[robot]", "[damping.from_frf]\n" + frf("P.x", "P.x") + "[robot]"),
                       "give either damping.ratios or damping.from_frf, not both");
}

TEST(BadCase, KeysThatExcludeEachOtherAreNamed) {
  expect_problem("[damping]", "[modes]\ncount = 10\nup_to = \"3 kHz\"\n[damping]", "not both");
  expect_problem("frequency = \"29 Hz\"", "frequency = \"29 Hz\"\nmass = \"50 kg\"", "either frequency or mass");
  expect_problem("[damping]", "[damping]\nloss_factor = 0.01", "belongs to damping.model = \"structural\"");
  expect_problem("[robot]",
                 "[selections.foot]\nplane = { point = [0,0,0], normal = \"y\" }\nsphere = { centre = [0,0,0], "
                 "radius = 1 }\n[robot]",
                 "exactly one of plane, box, sphere");
}

TEST(BadCase, MeasuredFilesMustExistAndCarryTheUnitOfTheirQuantity) {
  const std::string text =
      "[[part.measured]]\nresponse = \"P.x\"\nforce = \"P\"\nfile = \"absent.csv\"\n"
      "quantity = \"mobility\"\nunit = \"m/N\"\n";
  const auto problems = problems_of(text);
  ASSERT_EQ(problems.size(), 3U);
  EXPECT_NE(problems[0].text.find("names no direction; write for example \"P.x\""), std::string::npos);
  EXPECT_NE(problems[1].text.find("there is no file"), std::string::npos);
  EXPECT_NE(problems[2].text.find("is a unit of receptance, but the quantity is mobility"), std::string::npos);
}

TEST(BadCase, SeveralErrorsAreFoundInOnePassInTheOrderOfTheFile) {
  auto text = with(plate_case(), "poisson_ratio = 0.3", "poisson_ratio = 0.5");
  text = with(text, "density = \"7850 kg/m^3\"", "density = 7.85");
  text = with(text, "radial_depth = \"0.2 mm\"", "radial_depth = \"17 mm\"");
  text = with(text, "[[contacts]]\npart = \"P\"", "[[contacts]]\npart = \"Q\"\nnonsense = 1");
  text = with(text, "diameter = \"16 mm\"\n", "");
  const auto problems = problems_of(text);
  ASSERT_EQ(problems.size(), 5U);
  for (std::size_t i = 1; i < problems.size(); ++i) EXPECT_LE(problems[i - 1].line, problems[i].line);
  EXPECT_NE(problems[4].text.find("tool.diameter: missing"), std::string::npos) << problems[4].text;
  for (const auto& problem : problems) EXPECT_GT(problem.line, 0) << problem.text;
}

TEST(BadCase, EveryProblemIsPrintedWithFileLineAndColumn) {
  try {
    (void)parse_case(with(plate_case(), "teeth = 6", "teeth = 0"), ".", "cases/plate/case.toml");
    FAIL() << "no error";
  } catch (const CaseError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("cases/plate/case.toml:39:9: tool.teeth: 0 is out of range"))
        << error.what();
  }
}

TEST(Cases, EveryCaseOfTheProjectIsRight) {
  for (const auto* name : {"barrios-2019", "barrios-2019-measured", "cantilever-wall"}) {
    const auto folder = std::filesystem::path(THINWALL_SOURCE_DIR) / "cases" / name;
    EXPECT_NO_THROW({
      const Case c = read_case(folder);
      EXPECT_EQ(c.name, name);
      (void)read_expectations(c.file);
    });
  }
}

TEST(BadMesh, ToleranceAndSizeOutOfRangeOrAtOddsAreRefused) {
  expect_problem("element_size = \"12 mm\"", "tolerance = 0.5", "part.mesh.tolerance");
  expect_problem("element_size = \"12 mm\"", "tolerance = 1e-9", "part.mesh.tolerance");
  expect_problem("element_size = \"12 mm\"", "element_size = \"12 mm\"\ntolerance = 0.01", "nothing is estimated");
  expect_problem("element_size = \"12 mm\"", "element_size = \"12 mm\"\ntime_budget = \"9 s\"", "nothing is refined");
  expect_problem("element_size = \"12 mm\"", "time_budget = \"0 s\"", "part.mesh.time_budget");
  expect_problem("element_size = \"12 mm\"", "element_size = \"automatic\"", "auto");
  expect_problem("element_size = \"12 mm\"", "element_size = \"-1 mm\"", "above 0");
  expect_problem("element_size = \"12 mm\"", "quality = 1.2", "belongs to boxes with a given element_size");
}

}  // namespace
}  // namespace thinwall::tests::bad_case_test

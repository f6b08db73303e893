// Measured components of a case: which files make a matrix, what a file may not contradict, what sensors weigh.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>

#include "app/case_run.hpp"
#include "case/problem.hpp"
#include "case/reader.hpp"
#include "core/atomic_file.hpp"
#include "dynamics/conversion.hpp"
#include "io/frf/uff.hpp"
#include "io/matrices/mat_variables.hpp"
#include "report/tool_files.hpp"
#include "setup/measured.hpp"
#include "setup/measured_layout.hpp"
#include "setup/robot_tip.hpp"
#include "setup/sensor_mass.hpp"
#include "study/support/support_stage.hpp"
#include "tests/app/command_call.hpp"
#include "tests/case/case_text.hpp"
#include "tests/case/problems_of.hpp"
#include "tests/core/temporary_folder.hpp"

namespace thinwall::tests::measured_case_test {

using namespace setup;
using namespace cases;
using namespace study;
using namespace app;

namespace {

using Complex = std::complex<double>;
namespace fs = std::filesystem;

const std::string lines = "[response]\nfrom = \"20 Hz\"\nto = \"500 Hz\"\nlines = 241\n";

dynamics::FrequencyAxis measured_axis() {
  return dynamics::linear_axis(20.0, 500.0, 241);
}

/// A body with these points, three translations each, and resonances among the lines.
dynamics::SpatialModel body(const std::vector<std::string>& points, unsigned seed) {
  dynamics::SpatialModel model;
  for (const std::string& point : points) {
    for (const dynamics::Dof& dof : dynamics::translations(point)) model.dofs.push_back(dof);
  }
  const auto n = static_cast<Eigen::Index>(model.dofs.size());
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto square = [&] { return Eigen::MatrixXd::NullaryExpr(n, n, [&] { return uniform(random); }).eval(); };
  const Eigen::MatrixXd A = square(), B = square();
  model.M = 0.5 * Eigen::MatrixXd::Identity(n, n) + 0.1 * A * A.transpose();
  model.K = 1e6 * (0.5 * Eigen::MatrixXd::Identity(n, n) + B * B.transpose());
  model.C = 2e-5 * model.K;
  return model;
}

/// With a mass at every translation of a point.
dynamics::SpatialModel loaded(dynamics::SpatialModel model, const std::string& point, double mass) {
  for (const int row : dynamics::rows_of_point(model.dofs, point)) model.M(row, row) += mass;
  return model;
}

/// Largest distance of two responses over the largest entry of the line, DOFs by their names.
double difference(const dynamics::ResponseModel& a, const dynamics::ResponseModel& b) {
  double worst = 0.0;
  std::vector<int> rows;
  for (const dynamics::Dof& dof : a.responses) rows.push_back(dynamics::row_of(b.responses, dynamics::name(dof)));
  for (std::size_t line = 0; line < a.H.size(); ++line) {
    const Eigen::MatrixXcd in_order = b.H[line](rows, rows);
    worst = std::max(worst, (a.H[line] - in_order).cwiseAbs().maxCoeff() / in_order.cwiseAbs().maxCoeff());
  }
  return worst;
}

/// frequency, real, imaginary part of `values`.
void write_csv(const fs::path& file, const dynamics::FrequencyAxis& axis, const Eigen::VectorXcd& values) {
  std::ofstream out(file);
  out.precision(17);
  for (Eigen::Index line = 0; line < axis.size(); ++line)
    out << axis.hz(line) << ", " << values(line).real() << ", " << values(line).imag() << '\n';
}

std::string entry(const std::string& owner, const std::string& response, const std::string& force,
                  const std::string& file, const std::string& more) {
  return "[[" + owner + ".measured]]\nresponse = \"" + response + "\"\nforce = \"" + force + "\"\nfile = \"" + file +
         "\"\n" + more;
}

std::string sensor(const std::string& owner, const std::string& at, const std::string& mass) {
  return "[[" + owner + ".sensors]]\nat = \"" + at + "\"\nmass = \"" + mass + "\"\n";
}

void expect_problem(const std::string& text, const std::string& key, const std::string& part, const fs::path& folder) {
  const auto problems = problems_of(text, folder);
  ASSERT_EQ(problems.size(), 1U) << part << (problems.size() > 1 ? ": " + problems[1].text : "");
  EXPECT_EQ(problems[0].text.find(key + ":"), 0U) << problems[0].text;
  EXPECT_NE(problems[0].text.find(part), std::string::npos) << problems[0].text;
  EXPECT_GT(problems[0].line, 0) << problems[0].text;
}

/// Upper half of the matrix as accelerances, a CSV each, and the case's tables of them.
std::string part_by_accelerances(const fs::path& folder, const dynamics::ResponseModel& measured) {
  std::string text;
  for (std::size_t i = 0; i < measured.responses.size(); ++i) {
    for (std::size_t j = i; j < measured.forces.size(); ++j) {
      const std::string response = dynamics::name(measured.responses[i]), force = dynamics::name(measured.forces[j]);
      Eigen::VectorXcd values = dynamics::entry(measured, response, force);
      for (Eigen::Index line = 0; line < values.size(); ++line)
        values(line) *= -std::pow(measured.axis.omega_rad_s(line), 2);
      const std::string file = response + "_" + force + ".csv";
      write_csv(folder / file, measured.axis, values);
      text += entry("part", response, force, file, "quantity = \"accelerance\"\nunit = \"m/s^2/N\"\n");
    }
  }
  return text;
}

/// The whole matrix in one Universal File, and the case's tables of it.
std::string robot_by_universal_file(const fs::path& folder, const dynamics::ResponseModel& measured) {
  io::write_uff(folder / "robot.uff", measured);
  std::string text = "[robot]\nmodel = \"measured\"\n";
  int record = 0;
  for (const dynamics::Dof& response : measured.responses) {
    for (const dynamics::Dof& force : measured.forces)
      text += entry("robot", dynamics::name(response), dynamics::name(force), "robot.uff",
                    "record = " + std::to_string(++record) + "\n");
  }
  return text;
}

// The bare body is known, so what remains of the measured one is checked against another route: its own matrices.
TEST(SensorMass, OfTwoSensorsIsTakenOffAMeasuredPart) {
  const TemporaryFolder folder;
  const dynamics::SpatialModel bare = body({"P", "Q"}, 3);
  const auto with = dynamics::direct_response(loaded(loaded(bare, "P", 0.05), "Q", 0.035), measured_axis());
  const std::string text = part_by_accelerances(folder.path, with) + lines;
  const auto truth = dynamics::direct_response(bare, measured_axis());
  const Case with_sensors = parse_case(text, folder.path);
  EXPECT_GT(difference(measured_part(with_sensors, measured_axis()).response, truth), 0.05);
  const Case corrected = parse_case(text + sensor("part", "Q", "35 g") + sensor("part", "P", "50 g"), folder.path);
  EXPECT_LT(difference(measured_part(corrected, measured_axis()).response, truth), 1e-8);
}

TEST(SensorMass, IsTakenOffARobotMeasuredAsAMatrix) {
  const TemporaryFolder folder;
  const dynamics::SpatialModel bare = body({"R"}, 4);
  const auto with = dynamics::direct_response(loaded(bare, "R", 0.2), measured_axis());
  const std::string text = robot_by_universal_file(folder.path, with) + lines;
  const auto truth = dynamics::direct_response(bare, measured_axis());
  const auto found = [&](const std::string& sensors) {
    return robot_component(*parse_case(text + sensors, folder.path).robot, measured_axis(), {}).response;
  };
  EXPECT_GT(difference(found(""), truth), 0.05);
  EXPECT_LT(difference(found(sensor("robot", "R", "0.2 kg")), truth), 1e-8);
  EXPECT_LT(difference(found(sensor("robot", "R", "150 g") + sensor("robot", "R", "50 g")), truth), 1e-8);
}

/// 1/(k + iωc − ω²M) of one mass.
Eigen::VectorXcd one_mass(const dynamics::FrequencyAxis& axis, double mass) {
  Eigen::VectorXcd H(axis.size());
  for (Eigen::Index line = 0; line < H.size(); ++line) {
    const double omega = axis.omega_rad_s(line);
    H(line) = 1.0 / (1e6 - omega * omega * mass + Complex(0.0, 30.0 * omega));
  }
  return H;
}

TEST(SensorMass, IsTakenOffOneReceptanceAlongASlantedDirection) {
  const TemporaryFolder folder;
  write_csv(folder.path / "tip.csv", measured_axis(), one_mass(measured_axis(), 2.1));
  const std::string text = "[robot]\nmodel = \"measured\"\ndirection = [3, 4, 0]\n" + lines +
                           entry("robot", "R.x", "R.x", "tip.csv", "quantity = \"receptance\"\nunit = \"m/N\"\n") +
                           sensor("robot", "R", "100 g");
  const auto tip = robot_component(*parse_case(text, folder.path).robot, measured_axis(), {}).response;
  const Eigen::VectorXcd truth = one_mass(measured_axis(), 2.0);
  for (Eigen::Index line = 0; line < truth.size(); ++line)
    EXPECT_LT(std::abs(tip.H[static_cast<std::size_t>(line)](0, 0) / truth(line) - 1.0), 1e-8);
}

TEST(SensorMass, ItsEffectIsOmegaSquaredTimesMassTimesReceptance) {
  const auto response = [](double mass) {
    dynamics::ResponseModel model{measured_axis(), {{"R", Eigen::Vector3d::UnitX()}}, {}, {}};
    model.forces = model.responses;
    for (const Complex& H : one_mass(model.axis, mass)) model.H.emplace_back(Eigen::MatrixXcd::Constant(1, 1, H));
    return model;
  };
  const auto effects = sensor_effects(response(2.1), response(2.0), "R");
  ASSERT_EQ(effects.size(), 1U);
  EXPECT_EQ(effects[0].dof, "R.x");
  const Eigen::VectorXcd H = one_mass(measured_axis(), 2.0);
  Eigen::Index peak = 0;
  const double largest = (measured_axis().hz.array() * 2.0 * std::numbers::pi)
                             .square()
                             .cwiseProduct(0.1 * H.cwiseAbs().array())
                             .maxCoeff(&peak);
  EXPECT_NEAR(effects[0].largest_change / largest, 1.0, 1e-9);
  EXPECT_EQ(effects[0].at_frequency_hz, measured_axis().hz(peak));
  ASSERT_TRUE(effects[0].resonance_with_hz && effects[0].resonance_without_hz);
  EXPECT_NEAR(*effects[0].resonance_with_hz, std::sqrt(1e6 / 2.1) / (2.0 * std::numbers::pi), 1e-6);
  EXPECT_NEAR(*effects[0].resonance_without_hz, std::sqrt(1e6 / 2.0) / (2.0 * std::numbers::pi), 1e-6);
}

TEST(SensorMass, IsRefusedWhereItCannotBeMeant) {
  const TemporaryFolder folder;
  write_csv(folder.path / "tip.csv", measured_axis(), one_mass(measured_axis(), 2.0));
  const std::string format = "quantity = \"receptance\"\nunit = \"m/N\"\n";
  const std::string part = entry("part", "P.x", "P.x", "tip.csv", format) + lines;
  EXPECT_TRUE(problems_of(part + sensor("part", "P", "5 g"), folder.path).empty());
  expect_problem(part + sensor("part", "Q", "5 g"), "part.sensors[0].at", "no measured point \"Q\"", folder.path);
  expect_problem(part + sensor("part", "P", "0 g"), "part.sensors[0].mass", "above 0 kg", folder.path);
  expect_problem(part + "[[part.sensors]]\nat = \"P\"\nmass = 5\n", "part.sensors[0].mass", "\"5 g\"", folder.path);
  expect_problem(plate_case() + sensor("part", "P", "5 g"), "part.sensors", "no FRFs to take their mass off", ".");
  expect_problem(plate_case() + sensor("robot", "R", "5 g"), "robot.sensors", "belongs to robot.model = \"measured\"",
                 ".");
}

TEST(MeasuredCase, AnEntryThatNoFileGivesIsSeenBeforeAnythingIsComputed) {
  const TemporaryFolder folder;
  write_csv(folder.path / "h.csv", measured_axis(), one_mass(measured_axis(), 2.0));
  const std::string format = "quantity = \"receptance\"\nunit = \"m/N\"\n";
  for (const auto& [owner, p, before] :
       {std::tuple{"robot", "R", "[robot]\nmodel = \"measured\"\n"}, {"part", "P", ""}}) {
    const std::string x = std::string(p) + ".x", y = std::string(p) + ".y", z = std::string(p) + ".z";
    const auto frf = [&, who = owner](const std::string& a, const std::string& b) {
      return entry(who, a, b, "h.csv", format);
    };
    const std::string key = std::string(owner) + ".measured", text = before + lines + frf(x, x) + frf(y, y);
    expect_problem(text, key,
                   "no file gives the response of " + x + " to a force at " + y + ", nor the reverse: add one",
                   folder.path);
    EXPECT_TRUE(problems_of(text + frf(y, x), folder.path).empty()) << "by reciprocity";
    EXPECT_TRUE(problems_of(text + frf(x, y) + frf(y, x), folder.path).empty());
    expect_problem(text + frf(z, z), key, "(and so for 2 more)", folder.path);
    expect_problem(text + frf(x, y) + frf(y, y), key + "[3].response", "is there twice", folder.path);
    const std::string turned = std::string(p) + ".-x";
    expect_problem(text + frf(x, y) + frf(turned, x) + frf(turned, y) + frf(turned, turned), key,
                   x + " and " + turned + " are along one line", folder.path);
  }
}

TEST(MeasuredCase, LinesThatAreLeftOutOfARobotsFrfAreNoneOfTheRun) {
  const TemporaryFolder folder;
  const Eigen::VectorXcd H = one_mass(measured_axis(), 2.0);
  write_csv(folder.path / "tip.csv", measured_axis(), H);
  const std::string format = "quantity = \"receptance\"\nunit = \"m/N\"\n";
  const auto robot = [&](const std::string& bounds) {
    return parse_case(
        "[robot]\nmodel = \"measured\"\n" + entry("robot", "R.x", "R.x", "tip.csv", format + bounds) + lines,
        folder.path);
  };
  const Case whole = robot("");
  EXPECT_EQ(frequency_axis(whole.response, whole, whole).hz, measured_axis().hz);
  const Case part = robot("from = \"101 Hz\"\nto = \"300 Hz\"\n");
  const dynamics::FrequencyAxis axis = frequency_axis(part.response, part, part);
  EXPECT_EQ(axis.hz(0), 102.0);
  EXPECT_EQ(axis.hz(axis.size() - 1), 300.0);
  const auto tip = robot_component(*part.robot, axis, {}).response;
  EXPECT_EQ(tip.H.front()(0, 0), H(41));
  const Case one_line = robot("from = \"101 Hz\"\nto = \"103 Hz\"\n");
  EXPECT_THROW((void)frequency_axis(one_line.response, one_line, one_line), core::InputError);
}

TEST(MeasuredCase, FilesOfAToolAreTakenWhereAllHaveLines) {
  const TemporaryFolder folder;
  write_csv(folder.path / "tip.csv", measured_axis(), one_mass(measured_axis(), 2.0));
  const std::string format = "quantity = \"receptance\"\nunit = \"m/N\"\n";
  const auto tool = [&](const std::string& of_x, const std::string& of_y) {
    const std::string whole = cutter_case();
    const auto modes = whole.find("[[tool.modes]]"), cut = whole.find("[cutting]");
    return parse_case(whole.substr(0, modes) + entry("tool", "x", "x", "tip.csv", format + of_x) +
                          entry("tool", "y", "y", "tip.csv", format + of_y) + whole.substr(cut),
                      folder.path)
        .tool.value();
  };
  EXPECT_TRUE(tool("", "").measured[0].content->warnings.empty());
  const Tool later_y = tool("to = \"400 Hz\"\n", "from = \"57 Hz\"\n");
  for (const MeasuredFrf& file : later_y.measured)
    EXPECT_EQ(receptance_of(file).axis.hz, measured_axis().hz.segment(19, 172)) << "58 Hz to 400 Hz";
  ASSERT_EQ(later_y.measured[0].content->warnings.size(), 1U);
  EXPECT_NE(later_y.measured[0].content->warnings[0].find("lines below 58 Hz are left out, too"), std::string::npos)
      << later_y.measured[0].content->warnings[0];
  report::write_tool_frf(folder.path / "tool_frf.csv", later_y);
  EXPECT_TRUE(fs::exists(folder.path / "tool_frf.csv"));
  EXPECT_THROW((void)tool("to = \"100 Hz\"\n", "from = \"200 Hz\"\n"), core::InputError);
}

TEST(MeasuredCase, TheCheckAndTheMatrixSayTheSame) {
  const auto frf = [](const char* response, const char* force) {
    return MeasuredFrf{response, force, "nowhere.csv", io::FrfQuantity::receptance, "m/N", "Hz", {}};
  };
  const std::vector<MeasuredFrf> files{frf("R.x", "R.x"), frf("R.z", "R.x"), frf("R.y", "R.y")};
  const MeasuredLayout layout = measured_layout(files);
  EXPECT_EQ(layout.dofs, (std::vector<std::string>{"R.x", "R.z", "R.y"}));
  EXPECT_EQ(layout.file, (Eigen::Matrix3i() << 0, 1, -1, 1, -1, -1, -1, -1, 2).finished());
  try {
    (void)measured_response(files, measured_axis());
    FAIL() << "a matrix with gaps";
  } catch (const core::InputError& error) {  // and not DataError: no file was looked for
    EXPECT_EQ(error.what(), fault_of_layout(files).text);
    EXPECT_NE(fault_of_layout(files).text.find("response of R.x to a force at R.y"), std::string::npos);
  }
}

TEST(MeasuredCase, AFileIsNotReadAsSomethingElseThanItSays) {
  const TemporaryFolder folder;
  io::write_uff(folder.path / "tip.uff", dynamics::direct_response(loaded(body({"R"}, 5), "R", 0.1), measured_axis()));
  const auto stated = [&](const std::string& quantity, const std::string& unit, const std::string& frequency) {
    return MeasuredFrf{"R.x",     "R.x", folder.path / "tip.uff", core::from_word<io::FrfQuantity>(quantity), unit,
                       frequency, 1};
  };
  const Eigen::VectorXcd H = read_measured(stated("", "", "Hz")).frf.H;
  EXPECT_EQ(read_measured(stated("receptance", "m/N", "Hz")).frf.H, H);
  const auto expect_refused = [&](const MeasuredFrf& frf, const std::string& part) {
    try {
      (void)read_measured(frf);
      ADD_FAILURE() << "read, though " << part;
    } catch (const core::DataError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("tip.uff:"), std::string::npos) << error.what();
    }
  };
  expect_refused(stated("accelerance", "m/s^2/N", "Hz"), "accelerance in m/s^2/N is stated, but the file says");
  expect_refused(stated("receptance", "um/N", "Hz"), "receptance in 1e-06 m/N is stated, but the file says");
  expect_refused(stated("receptance", "m/N", "rad/s"), "data set 58, record 8");
  const std::string text = "[robot]\nmodel = \"measured\"\n" + lines +
                           entry("robot", "R.x", "R.x", "tip.uff", "record = 1\nfrequency_unit = \"rad/s\"\n");
  expect_problem(text, "robot.measured[0].frequency_unit", "beside quantity and unit only", folder.path);
}

// One resonance of a single mode, in a vector and in an array of another program's file.
TEST(MeasuredCase, VariablesOfAnotherProgramsMatFileAreNamedByKeys) {
  const TemporaryFolder folder;
  io::MatVariable tip{"H00", {12, 1}, {}}, array{"FRF", {12, 2}, {}};
  Eigen::VectorXd hz = Eigen::VectorXd::LinSpaced(12, 20.0, 130.0);
  for (int column = 0; column < 2; ++column) {
    for (const double f : hz) {
      const Complex H = 1.0 / Complex(1.0 - std::pow(f / 80.0, 2), 0.04 * f / 80.0);
      array.re.push_back((column + 1) * H.real());
      array.im.push_back((column + 1) * H.imag());
    }
  }
  tip.re.assign(array.re.begin(), array.re.begin() + 12);
  tip.im.assign(array.im.begin(), array.im.begin() + 12);
  io::write_mat_variables(folder.path / "rig.mat", "of a rig", {io::mat_matrix("freq", hz), tip, array});
  const auto with_keys = [&](const std::string& keys) {
    return "[robot]\nmodel = \"measured\"\n[response]\nfrom = \"20 Hz\"\nto = \"130 Hz\"\nlines = 23\n" +
           entry("robot", "R.x", "R.x", "rig.mat", keys);
  };
  const std::string stated = "quantity = \"receptance\"\nunit = \"um/N\"\n";
  const auto read = [&](const std::string& keys) {
    const Case source = parse_case(with_keys(keys), folder.path);
    return read_measured(std::get<MeasuredRobot>(source.robot->model).measured.at(0)).frf.H;
  };
  const Eigen::VectorXcd one = read(stated + "variable = \"H00\"\nfrequency_variable = \"freq\"\n");
  ASSERT_EQ(one.size(), 12);
  EXPECT_NEAR(one(6).imag(), 1e-6 * tip.im[6], 1e-18);
  const Eigen::VectorXcd two = read(stated + "variable = \"FRF(:,2)\"\nfrequency_variable = \"freq\"\n");
  EXPECT_LT((two - 2.0 * one).norm(), 1e-15 * one.norm());
  const std::string key = "robot.measured[0]";
  expect_problem(with_keys("unit = \"um/N\"\nvariable = \"H00\"\nfrequency_variable = \"freq\"\n"), key + ".quantity",
                 "missing", folder.path);
  expect_problem(with_keys(stated + "variable = \"H00\"\n"), key + ".frequency_variable", "together tell", folder.path);
}

TEST(MeasuredCase, ARobotsFilesAreReadOnceInARun) {
  const TemporaryFolder folder;
  const std::string robot = robot_by_universal_file(
      folder.path, dynamics::direct_response(loaded(body({"R"}, 6), "R", 0.1), measured_axis()));
  const std::string part =
      part_by_accelerances(folder.path, dynamics::direct_response(body({"P"}, 7), measured_axis()));
  core::write_file_atomically(folder.path / "case.toml", part + robot + sensor("robot", "R", "100 g") + lines +
                                                             "[[contacts]]\npart = \"P\"\nstiffness = \"1e6 N/m\"\n");
  const Outcome outcome = call({"run", folder.path / "case.toml", "--out", folder.path / "results"}, run_case);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string log = core::read_file(folder.path / "results" / "run.log"), said = "the robot's sensor of 0.1 kg";
  const auto first = log.find(said);
  ASSERT_NE(first, std::string::npos) << log;
  EXPECT_EQ(log.find(said, first + 1), std::string::npos) << log;
  EXPECT_TRUE(fs::exists(folder.path / "results" / "robot" / "postures.csv"));
}

}  // namespace
}  // namespace thinwall::tests::measured_case_test

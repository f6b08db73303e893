// A robot that is known by tables of modes at postures, and asked for at another.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "case/checks/doubts.hpp"
#include "case/numbers.hpp"
#include "case/reader.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "setup/identified/draws.hpp"
#include "setup/identified/identify.hpp"
#include "setup/robot_tip.hpp"
#include "setup/simulation_faults.hpp"
#include "study/kept/kept_identified.hpp"
#include "tests/case/milling_robot.hpp"
#include "tests/core/temporary_folder.hpp"
#include "tests/robot/modes_of_matrices.hpp"

namespace thinwall::cases::learned_postures_test {
namespace {

/// A robot whose two modes cross over the posture u, 0 … 4: frequencies in closed form, shapes along x and along y.
struct ClosedForm {
  static double first_hz(double u) { return 20.0 * std::exp(0.05 * u); }
  static double second_hz(double u) { return 24.0 * std::exp(-0.04 * u); }
  static double damping(double u) { return 0.02 + 0.002 * u; }
};

std::string row(double hz, double damping, double along_x) {
  const std::string x = std::to_string(along_x), y = std::to_string(1.0 - along_x);
  return std::to_string(hz) + "," + std::to_string(damping) + "," + x + ",0,0,-" + x + "," + y + ",0,0,-" + y + "\n";
}

/// Writes tables of `count` postures, each mode in the line of its rank.
void write_postures(const std::filesystem::path& folder, int count) {
  std::ofstream list(folder / "postures.csv");
  list << "posture,u,same\n";
  for (int i = 0; i < count; ++i) {
    const double u = 4.0 * i / (count - 1);
    list << "p" << i << "," << u << ",1\n";
    std::ofstream table(folder / ("p" + std::to_string(i) + ".csv"));
    table << "frequency_hz,damping_ratio,R_1X_re,R_1X_im,L_1X_re,L_1X_im,R_1Y_re,R_1Y_im,L_1Y_re,L_1Y_im\n";
    const std::string first = row(ClosedForm::first_hz(u), ClosedForm::damping(u), 0.9);
    const std::string second = row(ClosedForm::second_hz(u), ClosedForm::damping(u), 0.1);
    table << (ClosedForm::first_hz(u) < ClosedForm::second_hz(u) ? first + second : second + first);
  }
}

std::string robot(const std::string& keys) {
  return "[robot]\nmodel = \"modal_table\"\ncarries = \"tool\"\npostures = \"postures.csv\"\n" + keys +
         "[tool]\nteeth = 2\ndiameter = \"10 mm\"\nlength = \"8 mm\"\n[cutting]\nradial_depth = \"5 mm\"\nKt = \"600 "
         "N/mm^2\"\n";
}

const std::string usual = "table = \"{posture}.csv\"\nover = [\"u\"]\n";

std::shared_ptr<const dynamics::ModalTable> modes(const Case& source) {
  return std::get<setup::TabledRobot>(source.robot->model).table_modes;
}

TEST(LearnedPostures, FollowModesThroughACrossingToAPostureBetween) {
  const tests::TemporaryFolder folder;
  write_postures(folder.path, 9);
  for (const double u : {0.75, 1.25, 3.25}) {
    Case source = parse_case(robot(usual + "at = [" + std::to_string(u) + "]\n"), folder.path);
    EXPECT_FALSE(modes(source)) << "reading a case learns nothing";
    setup::identify(source);
    ASSERT_TRUE(modes(source));
    const auto found = [&](double hz) {
      double nearest = HUGE_VAL;
      for (const dynamics::ModalTableRow& mode : modes(source)->rows)
        nearest = std::min(nearest, std::abs(mode.frequency_hz / hz - 1.0));
      return nearest;
    };
    EXPECT_LT(found(ClosedForm::first_hz(u)), 1e-3) << u;
    EXPECT_LT(found(ClosedForm::second_hz(u)), 1e-3) << u;
    EXPECT_TRUE(doubts_about(source).empty()) << doubts_about(source)[0];
    EXPECT_EQ(setup::fault_of_structure(source, setup::CutOn::carried), "")
        << "a simulation has the poles that it needs";
    for (const dynamics::ModalTableRow& mode : modes(source)->rows)
      EXPECT_NEAR(mode.damping_ratio, ClosedForm::damping(u), 2e-4);
  }
}

/// The first 21 postures of cases/posture-map: the way from place to place gives some modes other names.
TEST(LearnedPostures, DoubtNamesThatDependOnTheWay) {
  const tests::milling_robot::FewPostures few(21);
  const std::string text = few.text(tests::milling_robot::test_postures().front(), "");
  const std::vector<std::string> doubts = doubts_about(parse_case(text, few.folder.path));
  EXPECT_TRUE(std::ranges::any_of(doubts, [](const std::string& doubt) {
    return doubt.find("modes could not be followed over the postures without contradiction") != std::string::npos;
  }));
}

TEST(LearnedPostures, BeyondTheirHullAreDoubted) {
  const tests::TemporaryFolder folder;
  write_postures(folder.path, 6);
  const Case source = parse_case(robot(usual + "at = [5]\n"), folder.path);
  ASSERT_EQ(doubts_about(source).size(), 1U);
  // 1 of a range of 4
  EXPECT_NE(doubts_about(source)[0].find("robot.at lies 25 % of the postures' range beyond"), std::string::npos)
      << doubts_about(source)[0];
}

/// Writes tables of the modes of matrices at `count` postures, with masses at the tip.
void write_loaded(const std::filesystem::path& folder, int count, double mass_kg) {
  std::ofstream list(folder / "postures.csv");
  list << "posture,u\n";
  for (int i = 0; i < count; ++i) {
    const double u = 4.0 * i / (count - 1);
    list << "p" << i << "," << u << "\n";
    tests::Matrices robot = tests::two_points(1.0, 1.0 + 0.05 * u);
    robot.M.diagonal().head<2>().array() += mass_kg;
    std::ofstream table(folder / ("p" + std::to_string(i) + ".csv"));
    table.precision(17);
    table << "frequency_hz,damping_ratio,R_1X_re,R_1X_im,L_1X_re,L_1X_im,R_1Y_re,R_1Y_im,L_1Y_re,L_1Y_im\n";
    for (const dynamics::ModalTableRow& mode : tests::table_of(robot).rows) {
      table << mode.frequency_hz << "," << mode.damping_ratio;
      for (const int dof : {0, 1})
        table << "," << mode.right(dof).real() << "," << mode.right(dof).imag() << "," << mode.left(dof).real() << ","
              << mode.left(dof).imag();
      table << "\n";
    }
  }
}

/// Tables that were measured with a sensor teach the same as those without it, once its mass is taken off.
TEST(LearnedPostures, AreFreedOfASensorsMassBeforeAnythingIsLearned) {
  const tests::TemporaryFolder bare, loaded;
  write_loaded(bare.path, 9, 0.0);
  write_loaded(loaded.path, 9, 0.4);
  const std::string keys = usual + "at = [1.3]\n", sensor = "[[robot.sensors]]\nat = \"1\"\nmass = \"0.4 kg\"\n";
  const auto learned = [](const std::string& more, const std::filesystem::path& folder) {
    Case source = parse_case(robot(more), folder);
    EXPECT_TRUE(doubts_about(source).empty()) << doubts_about(source)[0];
    setup::identify(source);
    return modes(source)->rows;
  };
  const auto truth = learned(keys, bare.path), freed = learned(keys + sensor, loaded.path),
             with = learned(keys, loaded.path);
  ASSERT_EQ(freed.size(), truth.size());
  for (std::size_t k = 0; k < truth.size(); ++k) {
    EXPECT_NEAR(freed[k].frequency_hz / truth[k].frequency_hz, 1.0, 1e-6);
    EXPECT_NEAR(freed[k].damping_ratio / truth[k].damping_ratio, 1.0, 1e-5);
    const Eigen::MatrixXcd R = freed[k].right * freed[k].left.transpose(),
                           exact = truth[k].right * truth[k].left.transpose();
    EXPECT_LT((R - exact).norm(), 1e-5 * exact.norm());
  }
  EXPECT_LT(with.front().frequency_hz, 0.99 * truth.front().frequency_hz) << "the mass is felt";
}

/// A mass that is most of what moves is doubted with its condition, one that is more is refused.
TEST(LearnedPostures, DoubtAMassThatIsMostOfWhatMoves) {
  const tests::TemporaryFolder folder;
  write_loaded(folder.path, 5, 60.0);
  const auto text = [](const std::string& mass) {
    return robot(usual + "at = [1.3]\n[[robot.sensors]]\nat = \"1\"\nmass = \"" + mass + "\"\n");
  };
  const Case source = parse_case(text("60 kg"), folder.path);
  ASSERT_EQ(doubts_about(source).size(), 1U);
  // Of 60 kg and 3 kg along x errors grow (60 + 3)/3 times.
  EXPECT_NE(doubts_about(source)[0].find("grow 21 times at posture \"p"), std::string::npos) << doubts_about(source)[0];
  try {
    (void)parse_case(text("64 kg"), folder.path);
    FAIL() << "more was taken off than there is";
  } catch (const core::Error& error) {
    EXPECT_NE(std::string(error.what()).find("robot.sensors: "), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("64 kg is more than moves at \"1\""), std::string::npos) << error.what();
  }
}

/// The error of a case, "" without one.
std::string refusal(const std::string& text, const std::filesystem::path& folder) {
  try {
    (void)parse_case(text, folder);
  } catch (const core::Error& error) {
    return error.what();
  }
  return "";
}

TEST(LearnedPostures, RefuseWhatCannotBeLearnedFrom) {
  const tests::TemporaryFolder folder;
  write_postures(folder.path, 6);
  const auto told = [&](const std::string& keys, const std::string& words) {
    EXPECT_NE(refusal(robot(keys), folder.path).find(words), std::string::npos) << refusal(robot(keys), folder.path);
  };
  told("table = \"p0.csv\"\nover = [\"u\"]\nat = [1]\n", "{posture}");
  told(usual, "robot.at: has 0 numbers for the 1 columns of robot.over");
  told(usual + "at = [1, 2]\n", "robot.at: has 2 numbers");
  told("table = \"{posture}.csv\"\nat = [1]\n", "robot.over: no column is named");
  told("table = \"{posture}.csv\"\nover = [\"v\"]\nat = [1]\n", "no column \"v\"; it has posture, u, same");
  told("table = \"{posture}.csv\"\nover = [\"v\"]\nat = [1]\n", "robot.over: ");
  told("table = \"{posture}.csv\"\nover = [\"same\"]\nat = [1]\n", "robot.over: \"same\" is the same at all postures");
  told(usual + "at = [1]\ntable_point = \"7\"\n", "robot.table_point: \"7\" is no point of ");
  told(usual + "at = [1]\ntable_point = \"7\"\n", "it has \"1\"");
  told("table = \"modes_{posture}.csv\"\nover = [\"u\"]\nat = [1]\n", "modes_p0.csv");
  std::string without = robot("table = \"p0.csv\"\nat = [1]\n");
  without.erase(without.find("postures ="), without.find("table =") - without.find("postures ="));
  EXPECT_NE(refusal(without, folder.path).find("belongs to robot.postures"), std::string::npos) << without;
  core::write_file_atomically(folder.path / "p3.csv",
                              "frequency_hz,damping_ratio,R_1X_re,R_1X_im,L_1X_re,L_1X_im,R_1Y_re,R_1Y_im,L_1Y_re,"
                              "L_1Y_im\n20,0.02,0,0,0,0,0,0,0,0\n");
  told(usual + "at = [1]\n", "has a vector of zeros");
  std::filesystem::remove(folder.path / "postures.csv");
  told(usual + "at = [1]\n", "postures.csv");
}

/// Postures are told by their names and lines, under the key of their list.
TEST(LearnedPostures, RefuseAPostureThatStandsTwice) {
  const tests::TemporaryFolder folder;
  write_postures(folder.path, 6);
  const auto told = [&](const std::string& lines) {
    core::write_file_atomically(folder.path / "postures.csv", "posture,u,same\np0,0,1\np1,1,1\n" + lines);
    return refusal(robot(usual + "at = [1]\n"), folder.path);
  };
  EXPECT_NE(told("p0,2,1\n").find("robot.postures: "), std::string::npos) << told("p0,2,1\n");
  EXPECT_NE(told("p0,2,1\n").find("postures.csv:4: posture \"p0\" stands in line 2, too"), std::string::npos)
      << told("p0,2,1\n");
  EXPECT_NE(told("p2,1,1\n").find("\"p1\" and \"p2\" are at one place of u"), std::string::npos) << told("p2,1,1\n");
}

/// Draws scatter about what is expected, and each is a table of the same DOFs.
TEST(LearnedPostures, AreDrawnAboutWhatIsExpected) {
  const tests::TemporaryFolder folder;
  write_postures(folder.path, 6);
  Case source = parse_case(robot(usual + "at = [1.9]\n"), folder.path);
  setup::identify(source);
  ASSERT_EQ(setup::draws_of(source), static_cast<std::size_t>(setup::identified_draws));
  const double expected = modes(source)->rows.front().frequency_hz;
  double mean = 0.0, square = 0.0;
  for (std::size_t i = 0; i < setup::draws_of(source); ++i) {
    setup::CutSetup cut = source;
    setup::SupportSetup support = source;
    setup::take_draw(i, cut, support);
    const auto& drawn = *std::get<setup::TabledRobot>(support.robot->model).table_modes;
    ASSERT_EQ(drawn.dofs.size(), modes(source)->dofs.size());
    const double off = std::log(drawn.rows.front().frequency_hz / expected);
    mean += off / setup::identified_draws;
    square += off * off / setup::identified_draws;
  }
  EXPECT_GT(square, 0.0);
  EXPECT_LT(std::abs(mean), 4.0 * std::sqrt(square / setup::identified_draws));
}

/// A variation of the posture that is asked for learns anew, one of another number takes what was learned.
TEST(LearnedPostures, OfAVariationAreThoseOfItsPosture) {
  const tests::TemporaryFolder folder;
  write_postures(folder.path, 9);
  Case source = parse_case(robot(usual + "at = [0.75]\n"), folder.path);
  const setup::Variation given = variation_of(source);
  setup::identify(source);
  const setup::Variation variation = study::identified_variation(given, source);
  const auto modes_of = [](const setup::Setup& varied) {
    return std::get<setup::TabledRobot>(varied.robot->model).table_modes;
  };
  EXPECT_EQ(modes_of(variation.with({{"tool.diameter", 0.012}})), modes(source));
  const auto there = modes_of(variation.with({{"robot.at", 3.25}}));
  ASSERT_TRUE(there);
  EXPECT_NEAR(std::ranges::max(there->rows, {}, &dynamics::ModalTableRow::frequency_hz).frequency_hz,
              ClosedForm::first_hz(3.25), 0.03);
}

TEST(LearnedPostures, OfTooFewPosturesLearnNothing) {
  const tests::TemporaryFolder folder;
  write_postures(folder.path, 3);
  const std::string told = refusal(robot(usual + "at = [1]\n"), folder.path);
  EXPECT_NE(told.find("no mode was seen at enough of the 3 postures"), std::string::npos) << told;
}

}  // namespace
}  // namespace thinwall::cases::learned_postures_test
